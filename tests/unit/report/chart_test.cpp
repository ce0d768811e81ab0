// Charts on logarithmic axes and as files of their own.
#include "report/chart.hpp"

#include <cstdio>
#include <gtest/gtest.h>

namespace cnem::report {
namespace {

Chart decades() {
  Chart chart;
  chart.title = "growth";
  chart.x_unit = chart.y_unit = "";
  chart.log_x = chart.log_y = true;
  chart.series = {{"cost", {0.0, 1e3, 1e4, 1e5}, {1.0, 10.0, 100.0, 1000.0}}};
  return chart;
}

TEST(Chart, decades_stand_equally_far_apart_and_what_has_no_logarithm_is_left_out) {
  const std::string svg = svg_chart(decades());
  const std::size_t path = svg.rfind(" d=\"M");
  ASSERT_NE(path, std::string::npos);
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(svg.c_str() + path, " d=\"M%lf %lfL%lf %lfL%lf %lf\"", &x[0], &y[0], &x[1], &y[1],
                        &x[2], &y[2]),
            6)
      << svg.substr(path, 80);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
}

TEST(Chart, a_file_says_what_it_is_and_brings_its_colours) {
  const std::string svg = svg_file(decades());
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" ")) << svg.substr(0, 60);
  EXPECT_NE(svg.find("<style>"), std::string::npos);
  EXPECT_NE(svg.find("viewBox"), std::string::npos);
}

} // namespace
} // namespace cnem::report
