// Which fields the files of a run hold.
#include "input/case_reader.hpp"
#include "mechanics/field_catalogue.hpp"
#include "results/fields.hpp"
#include "results/recorder.hpp"
#include "results/vtk_reader.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::app {
namespace {

class RecordedFields : public ::testing::Test {
protected:
  void record(const input::Case& input) {
    ExplicitSolver<2> solver = testing::solver_of(input);
    for (int k = 0; k < 3; ++k) solver.advance(0.5 * solver.stable_step().dt);
    results::FileQueue files;
    results::FieldRecorder(folder_.path(), input).record(files, results::snapshot(solver));
    files.wait();
    file_ = folder_.path() / results::read_field_series(folder_.path()).front().cells;
  }
  bool holds(const std::string& field) const {
    return results::has_cell_field(file_, results::array_in_files(field_info<2>(field)));
  }
  Field values(const std::string& field) const {
    return results::read_cell_fields(file_, {results::array_in_files(field_info<2>(field))}, Vec2(0, 0))
        .values.front();
  }

private:
  testing::TemporaryFolder folder_{"recorded_fields"};
  std::filesystem::path file_;
};

TEST_F(RecordedFields, plies_that_fail_in_plane_stress) {
  record(input::read_case(CNEM_SOURCE_DIR "/cases/composites/gfrp/case.toml", {"let.spacing=0.1 mm"}));
  for (const char* const field : {"thickness", "fibre_angle", "fibre_tension_damage",
                                  "matrix_compression_damage", "shear_damage", "matrix_tension_index"})
    EXPECT_TRUE(holds(field)) << field;
  EXPECT_FALSE(holds("softening")) << "of damage laws of metals";
  for (const double angle : values("fibre_angle")) EXPECT_NEAR(angle, 0.25 * std::numbers::pi, 1e-3);
}

TEST_F(RecordedFields, metal_that_cannot_break) {
  record(input::read_case_text(testing::punched_block + "[time]\nend = \"2 us\"\n", "punched"));
  EXPECT_TRUE(holds("plastic_strain"));
  for (const char* const field : {"thickness", "fibre_angle", "softening", "matrix_compression_damage"})
    EXPECT_FALSE(holds(field)) << field;
}

} // namespace
} // namespace cnem::app
