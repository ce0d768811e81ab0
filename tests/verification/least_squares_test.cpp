// Moving least squares on cells and at Gauss points against natural neighbours, where metal is sheared and
// cut.
#include "adapted_run.hpp"

namespace cnem::testing {
namespace {

/// Mean over the second half of a run.
double late_mean(const results::HistoryTable& history, const std::string& name) {
  const auto& time = history.column[static_cast<std::size_t>(history.find("time[s]"))];
  const auto& value = history.column[static_cast<std::size_t>(history.find(name))];
  double sum = 0.0, over = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    if (time[k - 1] < 0.5 * time.back()) continue;
    sum += 0.5 * (value[k] + value[k - 1]) * (time[k] - time[k - 1]);
    over += time[k] - time[k - 1];
  }
  return sum / over;
}

struct Sheared {
  double force; ///< N/m, along the grip
  double residual;
};

/// cases/verification/sheared_block on a coarser cloud.
Sheared sheared(Texts overrides) {
  const TemporaryFolder folder("sheared");
  const input::Case input = input::read_case(CNEM_SOURCE_DIR "/cases/verification/sheared_block/case.toml",
                                             with({"cloud.spacing=0.2 mm", "output.pictures=[]"}, overrides));
  EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  const auto status = results::read_status(folder.path());
  return {std::abs(late_mean(results::read_history(folder.path() / results::files::history),
                             "support.top.force_x[N/m]")),
          std::abs(status.energy_residual)};
}

} // namespace

TEST(LeastSquares, a_block_is_sheared_with_the_force_of_natural_neighbours) {
  const Sheared sibson = sheared({}), mls = sheared({"method.functions=mls"}),
                efg = sheared({"method.name=efg"});
  EXPECT_NEAR(mls.force, sibson.force, 0.01 * sibson.force);
  EXPECT_NEAR(efg.force, sibson.force, 0.08 * sibson.force);
  EXPECT_NE(mls.force, sibson.force);
  for (const Sheared& run : {sibson, mls, efg}) EXPECT_LT(run.residual, 1e-3);
}

/// With passes, damage, and cuts through broken metal.
TEST(LeastSquares, a_slug_is_cut_from_a_sheet_that_follows_the_punch) {
  const std::string text = blanked_slug +
                           "[time]\nend = \"20 us\"\n[contact]\ndeformable = true\n[output]\nfields_every = "
                           "\"10 us\"\n";
  const double residual = 3e-3; // half a dozen coarse cells across the sheet
  const Adapted sibson = testing::run(text, {}, residual),
                mls = testing::run(text, {"method.functions=mls"}, residual);
  EXPECT_GT(mls.counted("cuts"), 0.0);
  EXPECT_GT(mls.counted("inserted"), 0.0);
  EXPECT_NEAR(mls.work(), sibson.work(), 0.1 * sibson.work());
  EXPECT_NE(mls.work(), sibson.work());
}

} // namespace cnem::testing
