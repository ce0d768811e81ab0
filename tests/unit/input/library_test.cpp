// The library of materials: its files, and cases that take materials from it.
#include "input/library.hpp"
#include "plasticity/hardening_laws.hpp"
#include "tests/unit/input/case_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

namespace cnem::input {
namespace {

using Texts = std::vector<std::string>;

std::string replaced_material(const std::string& name) {
  return replaced(small_case, "material = \"steel\"", fmt::format("material = \"{}\"", name));
}

Case read_text(const std::string& text, const Texts& overrides = {}) {
  return read_case_text(text, "case.toml", overrides);
}

class Library : public testing::TestWithParam<std::string> {
protected:
  const LibraryMaterial material = library_material(GetParam());

  const std::string& text(const char* key) const {
    const Setting* setting = material.settings.find(key);
    EXPECT_TRUE(setting) << key;
    static const std::string none;
    return setting ? std::get<std::string>(setting->value) : none;
  }
};

/// The constants a source speaks of: those it names at its beginning ("A, B: ..."), else all.
std::set<std::string> spoken_of(const std::string& source, const std::set<std::string>& all) {
  std::istringstream names(source.substr(0, std::min(source.find(": "), source.size())));
  std::set<std::string> spoken;
  for (std::string name; std::getline(names >> std::ws, name, ',');) {
    if (!all.contains(name)) return all;
    spoken.insert(name);
  }
  return spoken;
}

TEST_P(Library, says_what_it_is_and_where_it_was_measured) {
  EXPECT_GT(text("description").size(), 5U);
  EXPECT_GT(text("plastic.range.source").size(), 10U);
  EXPECT_EQ(material.material.name, GetParam());
  EXPECT_TRUE(material.material.hardening);
  if (!material.settings.find("heat")) {
    std::string notes;
    for (const std::string& note : material.settings.get<Texts>("notes")) notes += note;
    EXPECT_NE(notes.find("Without heat: "), std::string::npos) << "a cut heats";
    return;
  }
  EXPECT_GT(material.material.specific_heat, 0.0);
}

TEST_P(Library, has_a_source_for_each_constant) {
  for (const char* group : {"", "elastic", "plastic", "anisotropy", "damage", "heat"}) {
    const Setting* table = material.settings.find(group);
    if (!table) continue;
    std::set<std::string> constants;
    for (const Setting& member : table->members)
      if (member.given && member.key->type == Type::quantity) constants.insert(member.name);
    const auto sources = table->maybe<Texts>("source");
    ASSERT_TRUE(sources) << group;
    std::set<std::string> covered;
    for (const std::string& source : *sources) {
      EXPECT_GT(source.size(), 15U) << source;
      covered.merge(spoken_of(source, constants));
    }
    EXPECT_EQ(covered, constants) << group;
  }
}

TEST_P(Library, says_whether_its_damage_is_fitted) {
  if (!material.settings.find("damage")) return;
  const std::string& calibration = text("damage.calibration");
  std::string sources;
  for (const std::string& source : material.settings.get<Texts>("damage.source")) sources += source;
  EXPECT_EQ(calibration == "generic", sources.find("generic") != std::string::npos) << sources;
}

TEST_P(Library, has_a_positive_flow_stress_that_hardens_where_it_holds) {
  const plasticity::Material& metal = material.material;
  const auto [strains, rates, temperatures] = metal.measured;
  const auto low = [](const Range& range, double otherwise) {
    return range.bounded() ? range.low : otherwise;
  };
  const auto high = [](const Range& range, double otherwise) {
    return range.bounded() ? range.high : otherwise;
  };
  const double melting = metal.hardening->melting_temperature();
  const double hottest = std::min(high(temperatures, 1500.0), 0.95 * melting);
  for (const double s : {0.0, 0.01, 0.3, 1.0})
    for (const double r : {0.0, 0.1, 0.5, 1.0})
      for (const double t : {0.0, 0.3, 0.7, 1.0}) {
        const double strain = low(strains, 0.0) + s * (high(strains, 2.0) - low(strains, 0.0));
        const double slow = std::max(low(rates, 1e-3), 1e-3);
        const double rate = slow * std::pow(high(rates, 1e6) / slow, r);
        const double cold = low(temperatures, 293.15), temperature = cold + t * (hottest - cold);
        const double stress = metal.hardening->flow_stress(strain, rate, temperature);
        EXPECT_GT(stress, 1e6) << strain << ' ' << rate << ' ' << temperature;
        EXPECT_LT(stress, 1e10) << strain << ' ' << rate << ' ' << temperature;
        EXPECT_GE(metal.hardening->hardening_modulus(strain + 1e-6, rate, temperature), 0.0);
      }
}

TEST_P(Library, is_taken_by_a_case_as_it_is) {
  Texts sheet; // plies flow in plane stress alone
  if (material.material.ply) sheet = {"analysis.kinematics=plane stress"};
  const Case taken = read_text(replaced_material("lib:" + GetParam()), sheet);
  EXPECT_EQ(taken.domain.material, GetParam());
  const plasticity::Material& metal = taken.material(GetParam());
  EXPECT_EQ(metal.density, material.material.density);
  EXPECT_EQ(metal.hardening->flow_stress(0.3, 100.0, 400.0),
            material.material.hardening->flow_stress(0.3, 100.0, 400.0));
  EXPECT_EQ(metal.damage.has_value(), material.material.damage.has_value());
  EXPECT_EQ(taken.analysis.thermal, material.settings.find("heat") != nullptr);
}

INSTANTIATE_TEST_SUITE_P(Materials, Library, testing::ValuesIn(library_names()), [](const auto& entry) {
  std::string name = entry.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(LibraryOfMaterials, is_the_folder_of_the_source_tree) {
  Texts files;
  for (const auto& entry : std::filesystem::directory_iterator(CNEM_SOURCE_DIR "/materials"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().stem().string());
  std::sort(files.begin(), files.end());
  EXPECT_EQ(library_names(), files);
  for (const LibraryFile& file : library_files()) {
    std::ifstream stream(fmt::format("{}/materials/{}.toml", CNEM_SOURCE_DIR, file.name));
    EXPECT_EQ(file.text, std::string((std::istreambuf_iterator<char>(stream)), {})) << file.name;
  }
}

TEST(LibraryOfMaterials, has_the_constants_of_the_papers_cases) {
  const Case paper = read_case(CNEM_SOURCE_DIR "/cases/paper/shearing_sharp/case.toml");
  const Case taylor = read_case(CNEM_SOURCE_DIR "/cases/verification/taylor_ofhc/case.toml");
  const auto expect_same = [](const plasticity::Material& a, const plasticity::Material& b) {
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.elasticity.young, b.elasticity.young);
    EXPECT_EQ(a.elasticity.poisson, b.elasticity.poisson);
    EXPECT_EQ(a.specific_heat, b.specific_heat);
    const auto &p = a.hardening->as<plasticity::JohnsonCook>(),
               &q = b.hardening->as<plasticity::JohnsonCook>();
    for (const auto& parameter : plasticity::JohnsonCook::parameters)
      EXPECT_EQ(p.*parameter.value, q.*parameter.value) << parameter.info.name;
  };
  expect_same(paper.materials.front(), library_material("304L-paper004").material);
  expect_same(paper.materials.front(), library_material("304L").material);
  EXPECT_EQ(paper.materials.front().conductivity, library_material("304L-paper004").material.conductivity);
  expect_same(taylor.materials.front(), library_material("OFHC-copper").material);
}

/// Table 1 and the equations of paper 001; 2 G_f/σ_y as it prints them.
TEST(LibraryOfMaterials, has_flax_and_pla_of_paper_001) {
  const plasticity::Material flax = library_material("flax-paper001").material,
                             pla = library_material("PLA-paper001").material;
  const auto strength = [](const plasticity::Material& m) {
    return m.hardening->flow_stress(1.0, 0.0, 293.15);
  };
  const auto griffith = [](double stress, double young) { // (20)
    return stress * stress * std::numbers::pi * 15e-6 / (4.0 * young);
  };
  ASSERT_TRUE(flax.ply && flax.damage && pla.damage);
  EXPECT_EQ(flax.ply->E1, 50e9);
  EXPECT_EQ(strength(flax), 750e6);
  EXPECT_NEAR(flax.damage->fracture_energy, griffith(strength(flax), flax.ply->E1), 0.6);
  EXPECT_NEAR(strength(pla), 64e6, 1.0);
  EXPECT_NEAR(griffith(strength(pla), pla.elasticity.young), 34.5, 0.05);
  EXPECT_NEAR(2.0 * pla.damage->fracture_energy / strength(pla), 156e-6, 0.5e-6);
  const auto& ratios = std::get<plasticity::HillRatios>(*flax.anisotropy);
  EXPECT_NEAR(ratios.R22 * strength(flax), 150e6, 1.0);
  EXPECT_NEAR(ratios.R12 * strength(flax) / std::sqrt(3.0), 20e6, 20.0);
}

TEST(LibraryOfMaterials, leaves_a_resolved_case_that_stands_alone) {
  const Case taken = read_text(replaced_material("lib:304L"));
  EXPECT_EQ(taken.resolved.find("\"lib:304L\""), taken.resolved.find("origin = ") + 9);
  expect_parts(taken.resolved, {"material = \"304L\"", "[materials.304L.plastic]", "A = \"253000000 Pa\"",
                                "source = [\"paper 004, section 5.4.3"});
  const Case again = read_text(taken.resolved);
  EXPECT_EQ(again.resolved.substr(again.resolved.find('\n')),
            taken.resolved.substr(taken.resolved.find('\n')));
}

TEST(LibraryOfMaterials, gives_a_base_whose_constants_a_case_changes) {
  const Case changed =
      read_text(replaced_material("mine") +
                "[materials.mine]\nbase = \"lib:304L\"\nleave_out = \"damage\"\nplastic.A = \"300 MPa\"\n");
  const plasticity::Material& metal = changed.material("mine");
  EXPECT_EQ(metal.hardening->as<plasticity::JohnsonCook>().A, 300e6);
  EXPECT_EQ(metal.hardening->as<plasticity::JohnsonCook>().B, 685e6);
  EXPECT_FALSE(metal.damage);
  expect_parts(changed.resolved, {"origin = \"lib:304L; changed by the case: plastic.A; left out: damage\"",
                                  "\"A: changed by the case\"]"});
  EXPECT_EQ(changed.resolved.find("base = "), std::string::npos);
}

TEST(LibraryOfMaterials, gives_way_to_a_law_of_the_case) {
  const Case other = read_text(replaced_material("mine") +
                               "[materials.mine]\nbase = \"lib:304L\"\nleave_out = \"damage\"\n"
                               "plastic = { law = \"linear\", yield = \"1 GPa\", hardening = \"0 Pa\" }\n");
  EXPECT_EQ(other.material("mine").hardening->flow_stress(1.0, 1e4, 1000.0), 1e9);
  expect_parts(other.resolved, {"changed by the case: plastic; left out: damage"});
  EXPECT_EQ(other.resolved.find("Tmelt"), std::string::npos);
}

TEST(LibraryOfMaterials, serves_regions_and_overrides) {
  const Case parts = read_text(replaced(replaced_material("lib:304L"), "[cloud]",
                                        "interfaces.joint.points = [\"4 0 mm\", \"4 5 mm\"]\n"
                                        "regions.a = { at = \"1 1 mm\", material = \"lib:OFHC-copper\" }\n"
                                        "regions.b = { at = \"8 1 mm\", material = \"lib:304L\" }\n[cloud]"));
  EXPECT_EQ(parts.domain.regions.at(0).material, "OFHC-copper");
  EXPECT_EQ(parts.domain.regions.at(1).material, "304L");
  EXPECT_EQ(parts.materials.size(), 3U) << "each once, and the steel of the case";
  EXPECT_EQ(read_text(small_case, {"domain.material=lib:C45"}).domain.material, "C45");
  EXPECT_EQ(read_text(small_case, {"materials.steel={ base = \"lib:C45\" }"}).material("steel").density,
            7870.0);
}

TEST(LibraryOfMaterials, serves_a_case_without_materials_of_its_own) {
  const std::string text = replaced_material("lib:304L");
  const Case bare = read_text(text.substr(0, text.find("[materials")));
  ASSERT_EQ(bare.materials.size(), 1U);
  EXPECT_EQ(bare.materials.front().name, "304L");
  EXPECT_EQ(bare.location.at("domain.material"), "case.toml:5:1") << "where the case names it";
  EXPECT_EQ(bare.location.at("materials.304L.density"), "materials/304L.toml:8:1") << "where it is written";
}

TEST(LibraryOfMaterials, names_the_nearest_material) {
  expect_parts(refusal_of(replaced_material("lib:ofhc-coper")),
               {"case.toml:5:12: key 'domain.material': found \"lib:ofhc-coper\", expected a material of the "
                "library: lib:304L, ",
                "(did you mean 'lib:OFHC-copper'?)"});
  expect_parts(refusal_of(replaced_material("304L")),
               {"found \"304L\", expected one of the materials steel (did you mean 'lib:304L'?)"});
  try {
    library_material("2024-T351");
    FAIL();
  } catch (const InputError& error) {
    expect_parts(error.what(),
                 {"found \"2024-T351\", expected a material of the library", "lib:AA2024-T351"});
  }
}

} // namespace
} // namespace cnem::input
