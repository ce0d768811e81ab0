// What a case asks for and a method does not promise is refused by the promise's name
// (input/case_promises.cpp).
#include "input/case_parts.hpp"
#include "input/schema/diagnostics.hpp"
#include "tests/unit/input/case_text.hpp"

#include <algorithm>

namespace cnem::input {
namespace {

/// A method that promises nothing: moving least squares with points of their own, say.
constexpr Promises nothing{};
constexpr Promises everything{Promise::identity_values, Promise::non_negative_values, Promise::tiling_cells,
                              Promise::balanced_constant_stress, Promise::hoop_rows};

/// The promises that a case with these lines lacks at a key when its method promises nothing.
std::vector<Promise> lacking(const std::string& path, const std::string& more) {
  const Case c = read_small(more);
  EXPECT_TRUE(unmet_needs(c, everything).empty());
  std::vector<Promise> list;
  for (const Unmet& unmet : unmet_needs(c, nothing)) {
    EXPECT_NE(unmet.message.find(name_of(unmet.promise)), std::string::npos) << unmet.message;
    EXPECT_NE(unmet.message.find(", expected "), std::string::npos) << unmet.message;
    if (unmet.path == path) list.push_back(unmet.promise);
  }
  return list;
}

using List = std::vector<Promise>;

TEST(Promises, a_plain_total_lagrangian_case_needs_none) {
  EXPECT_TRUE(unmet_needs(read_small("[method]\nlagrangian = \"total\"\n"), nothing).empty());
}

TEST(Promises, new_references_need_history_that_is_carried) {
  EXPECT_EQ(lacking("method.lagrangian", ""), List{Promise::carried_history});
}

TEST(Promises, history_at_nodes_needs_one_point_per_node) {
  const List one{Promise::one_point_per_node};
  EXPECT_EQ(lacking("method.pressure_exchange", "[method]\npressure_exchange = 0.3\n"), one);
  EXPECT_EQ(lacking("adapt.resample", "[adapt]\nresample = true\n"),
            (List{Promise::one_point_per_node, Promise::tiling_cells}));
}

TEST(Promises, kinematics_statics_and_heat) {
  EXPECT_EQ(lacking("analysis.kinematics", "[analysis]\nkinematics = \"axisymmetric\"\n"),
            List{Promise::hoop_rows});
  EXPECT_EQ(lacking("analysis.thermal",
                    "heat = { specific_heat = \"500 J/(kg K)\", conductivity = \"15 W/(m K)\" }\n"),
            List{Promise::non_negative_values});
}

TEST(Promises, what_holds_or_touches_nodes_needs_interpolation) {
  const List interpolation{Promise::interpolating_values};
  EXPECT_EQ(lacking("boundary", "[boundary.wall]\npieces = [\"bottom\"]\nsymmetry = true\n"), interpolation);
  EXPECT_EQ(lacking("boundary", "heat = { specific_heat = \"500 J/(kg K)\", conductivity = \"15 W/(m K)\" "
                                "}\n[boundary.hot]\npieces = [\"bottom\"]\ntemperature = \"400 K\"\n"),
            interpolation);
  EXPECT_EQ(lacking("boundary", "[boundary.free]\npieces = [\"bottom\"]\npressure = \"1 MPa\"\n"), List{});
  EXPECT_EQ(lacking("tools", "[tools.punch]\ncircle = { centre = \"5 8 mm\", radius = \"2 mm\" }\n"),
            interpolation);
  EXPECT_EQ(lacking("contact.deformable", "[contact]\ndeformable = true\n"), interpolation);
}

TEST(Promises, identity_holds_one_point_per_node_and_interpolation_in_it) {
  EXPECT_TRUE(everything.keep(Promise::one_point_per_node));
  EXPECT_TRUE(everything.keep(Promise::carried_history)) << "held in one point per node";
  EXPECT_TRUE(everything.keep(Promise::interpolating_values));
  for (const Promise promise : all_promises) EXPECT_FALSE(name_of(promise).empty());
}

using Names = std::vector<std::string>;

TEST(Registry, names_methods_and_refuses_others) {
  EXPECT_EQ(methods::names_in(2), (Names{"cnem", "fe-triangles", "sph", "sph-consistent", "hybrid", "efg"}));
  EXPECT_EQ(methods::names_in(3), (Names{"cnem", "fe-tetrahedra"}));
  EXPECT_EQ(methods::names().size(), 7U);
  EXPECT_EQ(methods::names_that_keep(Promise::balanced_constant_stress, 2),
            (Names{"cnem", "fe-triangles", "sph-consistent", "hybrid"}));
  EXPECT_EQ(methods::names_that_keep(Promise::carried_history, 2),
            (Names{"cnem", "fe-triangles", "sph", "sph-consistent", "hybrid"}));
  EXPECT_EQ(methods::names_that_keep(Promise::hoop_rows, 3), Names{});
  EXPECT_THROW(methods::entry("sphe"), InputError);
}

/// The message that refuses a method; empty when it is made.
template<int dim> std::string refusal_by(std::string_view name) {
  try {
    methods::make<dim>(name, {});
    return {};
  } catch (const InputError& error) { return error.what(); }
}

TEST(Registry, refuses_methods_that_do_not_exist_in_the_dimension) {
  EXPECT_EQ(refusal_by<2>("fe-triangles"), "");
  EXPECT_EQ(refusal_by<3>("sph"), "found method 'sph' in 3 dimensions, expected one of cnem, fe-tetrahedra");
  EXPECT_EQ(refusal_by<2>("fe-tetrahedra"), "found method 'fe-tetrahedra' in 2 dimensions, expected one of "
                                            "cnem, fe-triangles, sph, sph-consistent, hybrid, efg");
  EXPECT_EQ(refusal_by<3>("cnem"), "") << "it finds tetrahedra of its own";
  EXPECT_NE(refusal_by<3>("fe-tetrahedra").find("found no tetrahedra"), std::string::npos);
}

TEST(CaseReader, particles_have_a_kernel_and_its_support) {
  const Case plain = read_small("[method]\nname = \"sph\"\n");
  EXPECT_EQ(plain.method.options.kernel, methods::Kernel::cubic_spline);
  EXPECT_EQ(plain.method.options.smoothing, 2.4);
  const Case chosen = read_small("[method]\nname = \"sph\"\nkernel = \"wendland_c2\"\nsmoothing = 3\n");
  EXPECT_EQ(chosen.method.options.kernel, methods::Kernel::wendland_c2);
  EXPECT_EQ(chosen.method.options.smoothing, 3.0);
  EXPECT_EQ(methods::make<2>(chosen.method.name, chosen.method.options)->name(), "sph_wendland_c2");
}

TEST(CaseReader, the_zone_of_natural_elements_is_where_the_cloud_is_finer) {
  const Case plain = read_small("[method]\nname = \"hybrid\"\n");
  EXPECT_EQ(plain.method.options.zone_spacing, 0.75 * plain.cloud.spacing);
  const Case chosen = read_small("[method]\nname = \"hybrid\"\nzone_spacing = \"0.1 mm\"\n");
  EXPECT_EQ(chosen.method.options.zone_spacing, 1e-4);
}

TEST(Promises, a_case_that_its_method_alone_refuses_is_told_from_a_wrong_one) {
  const std::string triangles = "[method]\nname = \"fe-triangles\"\npressure_exchange = 0.3\n";
  EXPECT_THROW(read_small(triangles), MethodRefusal);
  try {
    read_small(triangles + "functions = \"lagrange\"\n");
    FAIL();
  } catch (const MethodRefusal&) { FAIL() << "a name is wrong too"; } catch (const InputError&) {
  }
}

} // namespace
} // namespace cnem::input
