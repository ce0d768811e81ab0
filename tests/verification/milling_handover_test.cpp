// A workpiece that one milling run leaves and the next one takes.
#include "tests/finished_run.hpp"

#include "app/machining/left_workpiece.hpp"
#include "core/error.hpp"
#include "input/case_machining.hpp"
#include "input/left_workpiece.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace cnem::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* handed_on = R"toml(
[cutter]
diameter = "12 mm"
teeth = 3
helix = "30 deg"

[cutting.forces]
law = "linear"
Ktc = "767 MPa"
Krc = "168.8 MPa"
Kac = "222 MPa"
Kte = "27.7 N/mm"

[milling]
speed = "8000 rpm"
feed = "0.2 mm"
axial_depth = "2 mm"
side = "down"

[modes.tool]
frequency = "900 Hz"
damping = 0.05
stiffness = "8 N/um"
direction = "0 1 0"

[dexels]
layers = 2
steps = 180
)toml";

constexpr const char* handed_block = "{ from = \"0 -12 mm\", to = \"6 0 mm\", height = \"4 mm\" }";

std::string pass(const char* tip, const char* y) {
  return fmt::format(
      "\n[[milling.passes]]\ntip = \"{} mm\"\nstart = \"-9 {} mm\"\npath = [{{ to = \"14 {} mm\" "
      "}}]\n",
      tip, y, y);
}

class MillingHandover : public ::testing::Test {
protected:
  /// A case of this name whose run goes into a folder of its name.
  input::Case written(const std::string& name, const std::string& workpiece, const std::string& rest,
                      const std::string& type = "milling") const {
    const fs::path file = folder_.path() / (name + ".toml");
    std::string text = handed_on;
    text.insert(text.find("side ="), "workpiece = " + workpiece + "\n");
    std::ofstream(file) << "[analysis]\ntype = \"" << type << "\"\n" << text << rest;
    return input::read_case(file.string());
  }
  Exit run(const input::Case& input, const std::string& name) const {
    return app::run(input, {.output = at(name), .force = true, .threads = 1, .version = "test"});
  }
  const fs::path& folder() const { return folder_.path(); }
  fs::path at(const std::string& name) const { return folder() / name; }
  std::string bytes(const std::string& name, const char* file) const {
    return results::read_file(at(name) / file);
  }
  /// What a run has left, as the next one takes it.
  std::string left(const std::string& name) const {
    const input::Case next = written("next", fmt::format("{{ run = \"{}\" }}", name), pass("0", "9"));
    return app::left_workpiece_file(*app::workpiece_of_earlier_run(next));
  }
  /// The message with which the next run refuses what is in a folder.
  std::string refusal(const std::string& folder) const {
    try {
      app::workpiece_of_earlier_run(
          written("next", fmt::format("{{ run = \"{}\" }}", folder), pass("0", "9")));
    } catch (const InputError& error) { return error.what(); }
    return "";
  }

private:
  TemporaryFolder folder_{"handover"};
};

TEST_F(MillingHandover, TwoRunsAreOneToTheBit) {
  const std::string first = pass("2", "4.5"), second = pass("0", "5");
  ASSERT_EQ(run(written("both", handed_block, first + second), "both"), Exit::done);
  ASSERT_EQ(run(written("roughing", handed_block, first), "roughing"), Exit::done);
  ASSERT_EQ(run(written("finishing", "{ run = \"roughing\" }", second), "finishing"), Exit::done);

  EXPECT_EQ(left("both"), left("finishing")) << "every piece of matter";
  EXPECT_NE(left("both"), left("roughing"));
  EXPECT_EQ(bytes("both", results::files::machined_surface),
            bytes("finishing", results::files::machined_surface));
  const auto both = results::read_history(at("both") / results::files::history),
             roughing = results::read_history(at("roughing") / results::files::history),
             finishing = results::read_history(at("finishing") / results::files::history);
  ASSERT_EQ(both.rows(), roughing.rows() + finishing.rows());
  for (const char* name : {"Fx", "Fy", "Fz", "torque", "removed", "x", "y", "axis_x", "axis_z"})
    for (std::size_t row = 0; row < finishing.rows(); ++row)
      ASSERT_EQ(both.column[static_cast<std::size_t>(both.find(name))][roughing.rows() + row],
                finishing.column[static_cast<std::size_t>(finishing.find(name))][row])
          << name << " in row " << row;
  EXPECT_GT(results::read_status(at("finishing")).metric("milling.pass_1.Fy").value(), 50.0);
  EXPECT_EQ(results::read_status(at("roughing")).metric("milling.workpiece.after"),
            results::read_status(at("finishing")).metric("milling.workpiece.before"));
  EXPECT_NE(bytes("finishing", results::files::report).find((at("roughing")).string()), std::string::npos);
}

TEST_F(MillingHandover, LayersAreDividedAtANewTip) {
  // Slots that are wider than the block: a pass takes all that is over its tip.
  const std::string narrow = "{ from = \"0 -4 mm\", to = \"6 4 mm\", height = \"4 mm\" }";
  ASSERT_EQ(run(written("upper", narrow, pass("3", "0")), "upper"), Exit::done);
  ASSERT_EQ(run(written("lower", "{ run = \"upper\" }", pass("1.3", "0")), "lower"), Exit::done);
  const results::RunStatus status = results::read_status(at("lower"));
  EXPECT_NEAR(status.metric("milling.pass_1.removed").value(), 6e-3 * 8e-3 * 1.7e-3, 1e-12 * 8e-8);
  EXPECT_NEAR(status.metric("milling.pass_1.depth").value(), 1.7e-3, 1e-12);
  EXPECT_NEAR(status.metric("milling.workpiece.after").value(), 6e-3 * 8e-3 * 1.3e-3, 1e-12 * 6e-8);
}

TEST_F(MillingHandover, RefusesWhatIsNoFinishedRunOfPasses) {
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("next.toml:"), std::string::npos) << message;
    EXPECT_NE(message.find("milling.workpiece.run"), std::string::npos) << message;
  };
  expect(refusal("nowhere"), "there is no such folder");
  fs::create_directory(at("empty"));
  expect(refusal("empty"), "no run is in that folder");

  const std::string few = "\n[stability]\nspeeds = 2\ndepths = 2\n";
  ASSERT_EQ(run(written("lobes", handed_block, pass("0", "5") + few, "stability"), "lobes"), Exit::done);
  expect(refusal("lobes"), "is of analysis.type = \"stability\"");

  const std::string inside = "\n[[milling.passes]]\nstart = \"3 -5 mm\"\npath = [{ to = \"14 -5 mm\" }]\n";
  ASSERT_EQ(run(written("stuck", handed_block, inside), "stuck"), Exit::diverged) << "in matter";
  expect(refusal("stuck"), "did not finish (exit code 3");
  fs::remove(at("stuck") / results::files::status);
  expect(refusal("stuck"), "has not ended");

  std::ofstream(at("empty") / input::left_workpiece) << "no workpiece";
  expect(refusal("empty"), "cannot take");
}

TEST_F(MillingHandover, DoesNotReplaceTheRunThatItGoesOnFrom) {
  ASSERT_EQ(run(written("roughing", handed_block, pass("2", "4.5")), "roughing"), Exit::done);
  EXPECT_THROW(run(written("finishing", "{ run = \"roughing\" }", pass("0", "5")), "roughing"), InputError);
  EXPECT_TRUE(fs::exists(at("roughing") / input::left_workpiece));
}

TEST_F(MillingHandover, ASpringPassHasASurface) {
  ASSERT_EQ(run(written("cut", handed_block, pass("0", "5")), "cut"), Exit::done);
  ASSERT_EQ(run(written("spring", "{ run = \"cut\" }", pass("0", "5")), "spring"), Exit::done);
  const auto error = results::read_status(at("spring")).metric("milling.location_error");
  ASSERT_TRUE(error.has_value()) << "hardly anything is taken, and the whole side is machined";
  EXPECT_LT(std::abs(error.value()), 5e-5) << "the cut's is 1.6e-5";
}

TEST_F(MillingHandover, ARunThatWasDoneAgainIsNoLongerWhatItWas) {
  ASSERT_EQ(run(written("roughing", handed_block, pass("2", "4.5")), "roughing"), Exit::done);
  const input::Case next = written("finishing", "{ run = \"roughing\" }", pass("0", "5"));
  std::ofstream(folder() / "resolved.toml") << next.resolved;
  EXPECT_NO_THROW(input::read_case((folder() / "resolved.toml").string()));
  ASSERT_EQ(run(written("roughing", handed_block, pass("2", "4.4")), "roughing"), Exit::done);
  try {
    input::read_case((folder() / "resolved.toml").string());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("it has changed since this case was resolved"),
              std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace cnem::testing
