// Measured curves as machines write them, and the keys of a case that name them.
#include "input/measured_file.hpp"

#include "tests/temporary_folder.hpp"
#include "tests/unit/input/case_text.hpp"

#include <fstream>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;

class MeasuredFile : public ::testing::Test {
protected:
  std::string file(const std::string& text) {
    const fs::path path = temporary.path() / "m.csv";
    std::ofstream(path) << text;
    return path.string();
  }
  MeasuredCurve read(const std::string& text, std::vector<std::string> names = {},
                     std::array<std::optional<Unit>, 2> units = {}) {
    MeasuredColumns columns;
    columns.names = std::move(names);
    columns.units = units;
    columns.expected = {std::vector{dimension::length, dimension::time},
                        std::vector{dimension::force, dimension::force_per_length}};
    return read_measured(file(text), columns);
  }
  std::string refused(const std::string& text, std::vector<std::string> names = {}) {
    try {
      read(text, std::move(names));
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  const testing::TemporaryFolder temporary{"measured"};
};

TEST_F(MeasuredFile, of_each_kind_that_machines_write_is_the_same_curve) {
  const Unit mm = parse_unit("mm"), kN = parse_unit("kN");
  const std::vector<MeasuredCurve> curves{
      read("# press 3\nstroke[mm],force[kN]\n0,0\n0.5,+12.5\n1e0,3\n"),
      read("\xef\xbb\xbf\"Weg (mm)\";\"Kraft / kN\"\r\n0;0\r\n0,5;12,5;\r\n1,0;3\r\n"),
      read("t\ts in um\tF [N]\n1\t0\t0\n2\t500\t12500\n3\t1000\t3000\n", {"s", "F"}),
      read("stroke;force\nmm;kN\n0;0\n\n0.5;12.5\n1;3\n"),
      read("! no header\n0 ;0\n.5;12.5\n1;3\n", {}, {mm, kN}),
      read("3,9,0\n3,9,0.5\n", {"3", "2"}, {mm, kN}),
  };
  for (std::size_t k = 0; k + 1 < curves.size(); ++k) {
    EXPECT_EQ(curves[k].x, (std::vector<double>{0.0, 0.5e-3, 1e-3})) << k;
    EXPECT_EQ(curves[k].y, (std::vector<double>{0.0, 12.5e3, 3e3})) << k;
  }
  EXPECT_EQ(curves.back().y, (std::vector<double>{9e3, 9e3}));
  const MeasuredCurve line = read("t[us],F[N/mm]\n0,0\n1,2\n");
  EXPECT_EQ(line.dimension[0], dimension::time);
  EXPECT_EQ(line.dimension[1], dimension::force_per_length);
  EXPECT_EQ(line.y[1], 2000.0);
}

TEST_F(MeasuredFile, mistakes_name_line_and_column) {
  expect_parts(refused("s[mm],F[kN]\n0,1,2,3\n"), {"m.csv:2:1", "'0,1,2,3'", "decimal commas need ';'"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n1;1.234,5\n"), {"m.csv:3:3", "'1.234,5'", "thousands"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n1;1e307\n"), {"m.csv:3:3", "'1e307'", "a finite number"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n1;+-5\n"), {"m.csv:3:3", "'+-5'", "a finite number"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n1\n"), {"m.csv:3:1", "at least 2 fields"});
  expect_parts(refused("s[mm];F[kN]\n0;1\nend;1\n"), {"m.csv:3:1", "'end'", "begin with #"});
  expect_parts(refused("s;F[kN]\n0;1\n"), {"m.csv:1:1", "'s' without a unit", "a stroke or a time"});
  expect_parts(refused("s[mm];F[kg]\n0;1\n"), {"m.csv:1:7", "'F' in another unit", "a force"});
  expect_parts(refused("s[mm];F[kNn]\n0;1\n"), {"m.csv:1:7", "unknown unit 'kNn'"});
  expect_parts(refused("t[s];s[mm];F[kN]\n0;1;2\n"), {"m.csv:1:1", "'t', 's', 'F'", "`columns`"});
  expect_parts(refused("s[mm];Kraft[kN]\n0;1\n", {"s", "Kaft"}), {"m.csv:1:1", "did you mean 'Kraft'?"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n", {"1", "3"}), {"'3'"});
  expect_parts(refused("s[mm] F[kN]\n0 1\n"), {"m.csv:1:1", "at least two columns"});
  expect_parts(refused("s[mm];F[kN]\n0;1\n"), {"one line of points"});
  expect_parts(refused("# nothing\n"), {"found no lines"});
}

TEST(MeasuredCurves, grow_and_are_thinned_by_means) {
  std::vector<double> x{0, 1, 1, 2, 1.5, 3}, y{0, 1, 9, 2, 9, 3};
  EXPECT_EQ(keep_growing(x, y), 2U);
  EXPECT_EQ(x, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(y, x);
  average_over_parts(x, y, 4);
  EXPECT_EQ(x.size(), 4U);
  average_over_parts(x, y, 2);
  EXPECT_EQ(x, (std::vector<double>{0.5, 2.5}));
}

TEST(MeasuredCurves, say_what_is_left_out) {
  std::vector<double> x{0, 2, 1}, y{0, 1, 2};
  EXPECT_EQ(keep_growing(x, y, "a.csv", "stroke"),
            "1 of 3 points of a.csv are left out: there the stroke does not grow");
  EXPECT_EQ(keep_growing(x, y, "a.csv", "stroke"), "");
  std::vector<double> down{0, -1, -2}, force{0, 1, 2};
  EXPECT_THROW(keep_growing(down, force, "a.csv", "stroke"), InputError);
}

constexpr const char* press = R"([tools.punch]
rectangle = { from = "-1 5 mm", to = "5 8 mm" }
velocity = "0 -10 m/s"
[tools.die]
rectangle = { from = "5.1 -3 mm", to = "12 0 mm" }
)";

class MeasuredCase : public MeasuredFile {
protected:
  Case read_with(const std::string& more) {
    const fs::path path = temporary.path() / "case.toml";
    std::ofstream(path) << small_case << press << more;
    return read_case(path.string());
  }
};

TEST_F(MeasuredCase, a_single_curve_is_named_and_the_resolved_case_stands_alone) {
  file("s[mm];F[kN]\n0;0\n0,5;-10\n0,4;-9\n1;-4\n");
  const Case input = read_with("[report.experiment]\nfile = \"m.csv\"\nscale = -1\ncut_length = \"80 mm\"\n"
                               "shift = \"0.1 mm\"\ncompliance = \"0.01 mm/kN\"\n");
  ASSERT_EQ(input.report.experiments.size(), 1U);
  const Experiment& one = input.report.experiments[0];
  EXPECT_EQ(one.name, "measured");
  EXPECT_EQ(one.force, (std::vector<double>{0.0, 10e3, 4e3}));
  EXPECT_NEAR(one.x[1], 0.5e-3, 1e-15) << "0.1 mm later, 0.1 mm of the machine";
  EXPECT_NEAR(one.x[2], 1.06e-3, 1e-15);
  EXPECT_EQ(input.tools[one.tool].name, "punch");
  ASSERT_EQ(input.warnings.size(), 1U);
  expect_parts(input.warnings[0], {"1 of 4 points", "the stroke does not grow"});
  fs::remove(temporary.path() / "m.csv");
  const Case again = read_case_text(input.resolved, "elsewhere.toml");
  EXPECT_EQ(again.report.experiments.at(0).x, one.x);
  EXPECT_EQ(again.report.experiments[0].force, one.force);
}

TEST_F(MeasuredCase, several_curves_and_heights_of_faces) {
  const Case input =
      read_with("[report.blanking.measured.slug]\nrollover_share = \"15 %\"\nburr = \"20 um\"\n"
                "[report.experiment.a]\nstroke = [\"0 mm\", \"1 mm\"]\n"
                "force_per_length = \"0 500 N/mm\"\n"
                "[report.experiment.b]\ntool = \"die\"\ncomponent = \"across\"\n"
                "time = \"0 10 us\"\nforce = \"0 2 kN\"\ncut_length = \"1 mm\"\ncuts = 2\n");
  ASSERT_EQ(input.report.experiments.size(), 2U);
  EXPECT_TRUE(input.report.experiments[0].per_length);
  EXPECT_FALSE(input.report.experiments[1].over_stroke);
  EXPECT_EQ(input.report.experiments[1].cuts, 2.0);
  const MeasuredFace& face = input.report.blanking->measured.at(0);
  EXPECT_EQ(face.body, "slug");
  EXPECT_TRUE(face.rollover->share);
  EXPECT_EQ(face.rollover->value, 0.15);
  EXPECT_EQ(face.burr->value, 20e-6);
  EXPECT_FALSE(face.burnish);
}

TEST_F(MeasuredCase, what_makes_no_comparison_is_refused) {
  const auto refused_case = [&](const std::string& more) { return refusal(press + more); };
  const std::string points = "[report.experiment]\nstroke = \"0 1 mm\"\nforce = \"0 2 kN\"\n";
  expect_parts(refused_case(points), {"report.experiment.measured.cut_length", "perimeter of the blank"});
  expect_parts(refused_case(points + "cut_length = \"1 mm\"\ntool = \"punsh\"\n"), {"did you mean 'punch'?"});
  expect_parts(refused_case(points + "cut_length = \"1 mm\"\ntime = \"0 1 us\"\n"),
               {"both of stroke and time"});
  expect_parts(refused_case(points + "cut_length = \"1 mm\"\nscale = -1\n"), {"no force above 0"});
  expect_parts(refused_case(points + "cut_length = \"1 mm\"\nfile = \"a.csv\"\n"), {"beside a file"});
  expect_parts(refused_case("[report.experiment]\nstroke = \"0 1 mm\"\nforce_per_length = \"1 2 N/mm\"\n"
                            "compliance = \"1 mm/kN\"\n"),
               {"compliance", "the whole force"});
  expect_parts(refused_case("[report.experiment]\nstroke = \"0 1 2 mm\"\nforce = \"0 2 kN\"\n"),
               {"2 values for the 3"});
  expect_parts(refused_case("[report.experiment]\nstroke = \"0 2 1 mm\"\nforce = \"0 2 3 kN\"\n"),
               {"measured.stroke", "found 0.001 after 0.002"});
  file("s[mm];F[kN]\n0;0\n-0,5;10\n-1;4\n");
  expect_parts(refused_case(fmt::format("[report.experiment]\nfile = \"{}\"\ncut_length = \"1 mm\"\n",
                                        (temporary.path() / "m.csv").string())),
               {"measured.file", "m.csv", "from 0 to -0.001 (SI) and does not grow", "write it positive"});
  expect_parts(refused_case("[report.blanking.measured.slugg]\nburr = \"1 um\"\n"), {"did you mean 'slug'?"});
  expect_parts(refused_case("[report.blanking.measured.slug]\nburr = \"1 um\"\nburr_share = 0.1\n"),
               {"burr_share", "beside burr"});
}

} // namespace
} // namespace cnem::input
