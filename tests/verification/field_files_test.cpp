// Files of fields as VTK and Python read them.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/output_folder.hpp"
#include "results/vtk_reader.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace cnem::testing {
namespace {

/// What tests/verification/read_fields.py says of the lists of a run.
std::string read_by_python(const std::filesystem::path& folder, const std::string& lists) {
  std::string command = "/usr/bin/python3 " CNEM_SOURCE_DIR "/tests/verification/read_fields.py";
  std::istringstream names(lists);
  for (std::string name; names >> name;) command += " '" + (folder / name).string() + "'";
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  for (int c; (c = std::getc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << text << "\nmeshio of Debian's python3-meshio is needed (setup/packages.txt)";
  return text;
}

/// The same, as VTK reads the file.
std::string read_by_vtk(const std::filesystem::path& folder, const std::string& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / file).c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  std::string text;
  const auto show = [&](const char* where, const char* name, vtkDataArray& values) {
    double sum = 0.0;
    for (vtkIdType i = 0; i < values.GetNumberOfTuples(); ++i)
      for (int k = 0; k < values.GetNumberOfComponents(); ++k) sum += std::abs(values.GetComponent(i, k));
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{:.9g}\n", file, where, name, values.GetNumberOfComponents(),
                        values.GetNumberOfTuples(), sum);
  };
  show("place", "", *grid.GetPoints()->GetData());
  for (int k = 0; k < grid.GetPointData()->GetNumberOfArrays(); ++k)
    show("point", grid.GetPointData()->GetArrayName(k), *grid.GetPointData()->GetArray(k));
  for (int k = 0; k < grid.GetCellData()->GetNumberOfArrays(); ++k)
    show("cell", grid.GetCellData()->GetArrayName(k), *grid.GetCellData()->GetArray(k));
  return text;
}

std::filesystem::path run_into(const TemporaryFolder& temporary, const input::Case& input) {
  EXPECT_EQ(app::run(input, {.output = temporary.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  return temporary.path();
}

void expect_alike(const std::filesystem::path& folder, const std::string& lists,
                  const std::set<std::string>& named) {
  const std::string text = read_by_python(folder, lists);
  std::string expected;
  std::set<std::string> seen;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::string file = line.substr(0, line.find('\t')); seen.insert(file).second)
      expected += read_by_vtk(folder, file);
  EXPECT_EQ(text, expected);
  std::set<std::string> written;
  for (const auto& entry : std::filesystem::directory_iterator(folder / results::files::fields_folder))
    written.insert("fields/" + entry.path().filename().string());
  EXPECT_EQ(seen, written);
  for (const std::string& array : named)
    EXPECT_NE(text.find("\t" + array + "\t"), std::string::npos) << array;
}

TEST(FieldFiles, of_the_plane_are_read_by_vtk_and_by_python) {
  const TemporaryFolder temporary("fields");
  const auto folder = run_into(temporary, input::read_case_text(punched_block + R"toml(
[tools.anvil]
start = "-1 -1 mm"
path = [{ to = "5 -1 mm" }, { to = "5 0 mm", fillet = "0.2 mm" }, { to = "-1 0 mm" }]
[tools.punch.heat]
conductance = "1e5 W/(m2 K)"
conductivity = "60 W/(m K)"
density = "15000 kg/m3"
specific_heat = "200 J/(kg K)"
[tools.punch.heat.section]
spacing = "0.5 mm"
[time]
end = "2 us"
[output]
fields_every = "1 us"
pictures = "1.5 us"
picture_fields = ["stress_xy"]
)toml",
                                                                "punched"));
  expect_alike(folder, "fields.pvd tools.pvd",
               {"stress [Pa]\t6", "principal stresses [Pa]\t3", "stress triaxiality\t1",
                "displacement [m]\t3", "velocity [m/s]\t3", "surface_temperature [K]\t1"});
  const auto series = results::read_field_series(folder);
  ASSERT_EQ(series.size(), 4U) << "0, 1 and 2 us, and the time of the picture";
  EXPECT_EQ(series[2].time, 1.5e-6);
  ASSERT_EQ(series[3].parts.size(), 2U);
  EXPECT_EQ(series[3].parts[0].name, "punch");
  EXPECT_NEAR(results::read_tool_displacement(folder / series[3].parts[0].file).y(), -60e-6, 1e-9)
      << "led up to 60 m/s in 2 us";
  EXPECT_EQ(results::read_tool_displacement(folder / series[3].parts[1].file), Vec2(0, 0));
}

TEST(FieldFiles, of_space_are_read_by_vtk_and_by_python) {
  const TemporaryFolder temporary("fields_of_space");
  const auto folder = run_into(
      temporary, input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/taylor_tetrahedra/case.toml",
                                  {"cloud.spacing=1.6 mm", "time.end=2 us", "output.fields_every=2 us"}));
  expect_alike(folder, "fields.pvd", {"stress [Pa]\t6", "displacement [m]\t3"});
}

TEST(FieldFiles, stresses_are_those_of_their_principal_values) {
  const TemporaryFolder temporary("principal");
  const auto folder =
      run_into(temporary, input::read_case_text(pulled_block + "[output]\npictures = []\n", "pulled"));
  const auto series = results::read_field_series(folder);
  const auto read = results::read_cell_fields(folder / series.back().cells,
                                              {{"stress [Pa]", 1},
                                               {"stress [Pa]", 2},
                                               {"principal stresses [Pa]", 0},
                                               {"principal stresses [Pa]", 1},
                                               {"principal stresses [Pa]", 2},
                                               {"stress triaxiality"}},
                                              Vec2(0, 0));
  const auto at = [&](std::size_t field, std::size_t cell) { return read.values[field][cell]; };
  std::size_t free = 0; // away from the base nothing holds it across: σ_zz = ν σ_yy
  for (std::size_t c = 0; c < read.values[0].size(); ++c) {
    EXPECT_GE(at(2, c), at(3, c));
    EXPECT_GE(at(3, c), at(4, c));
    const double square = 0.5 * (std::pow(at(2, c) - at(3, c), 2) + std::pow(at(3, c) - at(4, c), 2) +
                                 std::pow(at(4, c) - at(2, c), 2));
    EXPECT_NEAR(at(5, c), (at(2, c) + at(3, c) + at(4, c)) / 3.0 / std::sqrt(square), 1e-6);
    if (std::abs(at(0, c) - 20e6) < 1e4) {
      ++free;
      EXPECT_NEAR(at(2, c), 20e6, 1e5);
    }
  }
  EXPECT_GT(free, 0U);
}

} // namespace
} // namespace cnem::testing
