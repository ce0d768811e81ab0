// Heat in tools that conduct: their share of the friction heat, what passes through the contact, and
// conduction in their sections, staggered behind the heat of the workpiece.
#include "core/fields/vector_at.hpp"
#include "mechanics/node_heat.hpp"
#include "mechanics/terms/list.hpp"
#include "thermal/conduction.hpp"
#include "thermal/conduction_interval.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace cnem {

namespace {

/// Between a node of the workpiece and a place on the face of a section.
struct Passage {
  NodeIndex node;
  FacePlace<2> face;
  double conductance; ///< W/(K m)
  double heat = 0.0;  ///< J/m into the tool, of a sub-step
};

class ToolHeat : public Term<2> {
public:
  explicit ToolHeat(const std::vector<ToolSection<2>>& sections) : course_(sections.size()) {
    for (std::size_t s = 0; s < sections.size(); ++s) {
      const ToolSection<2>& section = sections[s];
      Course& course = course_[s];
      course.conduction.set_operators(
          section.approximation.conduction,
          Field(index_of(section.approximation.conduction.points), section.conductivity));
      for (const Vec2& x : section.cloud.position)
        course.position.insert(course.position.end(), {x.x(), x.y()});
      course.flow.resize(section.nodes());
    }
  }

  std::vector<Energy*> energies() override { return {&content_, &generated_, &exchanged_}; }
  void archive(Archive& archive) override {
    for (std::size_t s = 0; s < course_.size(); ++s)
      course_[s].interval.archive(archive, fmt::format("solver/tool_heat/{}/", s));
  }

  void audit(const BodyView<2>& body) override {
    content_.value = 0.0;
    for (std::size_t s = 0; s < course_.size(); ++s) {
      const ToolSection<2>& section = body.model.tool_sections[s];
      const Field& temperature = body.state.tool_temperature[s];
      for (std::size_t i = 0; i < temperature.size(); ++i)
        content_.value +=
            section.heat_capacity[i] * section.curves_of(i).rise(section.temperature, temperature[i]);
    }
  }

  std::vector<Metric> metrics(const BodyView<2>& body) const override {
    std::vector<Metric> told;
    for (std::size_t s = 0; s < course_.size(); ++s) {
      const std::string& name = body.model.tool_sections[s].name;
      const Field& temperature = body.state.tool_temperature[s];
      told.push_back({name + ".max_temperature[K]", *std::max_element(temperature.begin(), temperature.end()),
                      "max_temperature." + name, Keep::largest});
    }
    return told;
  }

  void start(const Body<2>& body) override {
    body.state.tool_temperature.clear();
    for (const ToolSection<2>& section : body.model.tool_sections)
      body.state.tool_temperature.emplace_back(section.nodes(), section.temperature);
  }

  void end_step(const Body<2>& body, double dt) override {
    for (std::size_t s = 0; s < course_.size(); ++s) {
      const ToolSection<2>& section = body.model.tool_sections[s];
      Field& temperature = body.state.tool_temperature[s];
      find_passages(body, section);
      take_friction_heat(body, section, temperature);
      pass(body.model, section, dt, temperature, body.state.node);
      hold(section, temperature);
      Course& course = course_[s];
      if (course.interval.stable == 0.0) course.interval.stable = stable_step(section, course);
      if (const double interval = course.interval.add(dt); interval > 0.0)
        conduct(section, course, interval, temperature);
    }
  }

private:
  /// Of one section.
  struct Course {
    Conduction<2> conduction;
    Field position; ///< [node of the cloud] m, side by side
    Field flow;     ///< [node] W/m, scratch
    ConductionInterval interval;
  };

  /// The place of a node of the workpiece on the faces of a section.
  static FacePlace<2> face_at(const Body<2>& body, const ToolSection<2>& section, NodeIndex node) {
    const Vec2 moved = body.conditions.contact.displacement(index_of(section.tool), body.state.time);
    return section.nearest_on_faces(vector_at<2>(body.state.node.position, index_of(node)) - moved);
  }

  void find_passages(const Body<2>& body, const ToolSection<2>& section) {
    passages_.clear();
    const double conductance = section.contact_conductance();
    if (conductance == 0.0) return;
    for (const contact::ContactPoint<2>& touch : body.conditions.contact.points())
      if (touch.tool == section.tool)
        passages_.push_back({touch.node, face_at(body, section, touch.node), conductance * touch.area});
  }

  void take_friction_heat(const Body<2>& body, const ToolSection<2>& section, Field& temperature) {
    for (const contact::RubbedTool& rubbed : body.conditions.contact.rubbed_tools()) {
      if (rubbed.tool != section.tool) continue;
      const FacePlace<2> face = face_at(body, section, rubbed.node);
      for (std::size_t a = 0; a < 2; ++a) {
        const auto i = index_of(face.node[a]);
        warm(section, i, face.weight[a] * rubbed.heat, temperature);
      }
      generated_.value += rubbed.heat;
    }
  }

  /// Through the contact, in as many sub-steps as are stable: what leaves one side arrives at the other.
  void pass(const Model<2>& model, const ToolSection<2>& section, double dt, Field& temperature,
            NodeState<2>& node) {
    if (passages_.empty()) return;
    Field& rate = rate_; // Gershgorin: a row of exchange is twice what its node gives
    rate.assign(section.nodes(), 0.0);
    double fastest = 0.0;
    for (const Passage& passage : passages_) {
      const auto n = index_of(passage.node);
      fastest = std::max(fastest, 2.0 * passage.conductance /
                                      (node.heat_capacity[n] * curves_of<2>(model, node, n).quickest));
      for (std::size_t a = 0; a < 2; ++a) {
        const auto i = index_of(passage.face.node[a]);
        rate[i] += 2.0 * passage.face.weight[a] * passage.conductance /
                   (section.heat_capacity[i] * section.curves_of(i).quickest);
        fastest = std::max(fastest, rate[i]);
      }
    }
    const int substeps = stable_substeps(dt * fastest);
    for (int s = 0; s < substeps; ++s) {
      for (Passage& passage : passages_) {
        double opposite = 0.0;
        for (std::size_t a = 0; a < 2; ++a)
          opposite += passage.face.weight[a] * temperature[index_of(passage.face.node[a])];
        passage.heat =
            dt / substeps * passage.conductance * (node.temperature[index_of(passage.node)] - opposite);
      }
      for (const Passage& passage : passages_) {
        cnem::warm<2>(model, node, index_of(passage.node), -passage.heat);
        for (std::size_t a = 0; a < 2; ++a) {
          const auto k = index_of(passage.face.node[a]);
          warm(section, k, passage.face.weight[a] * passage.heat, temperature);
        }
      }
    }
  }

  /// Heat arrives at a node of the section, J/m.
  static void warm(const ToolSection<2>& section, std::size_t i, double heat, Field& temperature) {
    temperature[i] = section.curves_of(i).warmed(temperature[i], heat / section.heat_capacity[i]);
  }

  const Field& potential(const ToolSection<2>& section, const Field& temperature) {
    if (!section.heat_curves.given()) return temperature;
    potential_.resize(temperature.size());
    for (std::size_t i = 0; i < temperature.size(); ++i)
      potential_[i] = section.curves_of(i).potential(temperature[i]);
    return potential_;
  }

  void hold(const ToolSection<2>& section, Field& temperature) {
    for (const NodeIndex held : section.held) {
      const auto i = index_of(held);
      exchanged_.value +=
          section.heat_capacity[i] * section.curves_of(i).rise(temperature[i], section.temperature);
      temperature[i] = section.temperature;
    }
  }

  static double stable_step(const ToolSection<2>& section, Course& course) {
    Field quickest = section.heat_capacity;
    for (std::size_t i = 0; i < quickest.size(); ++i) quickest[i] *= section.curves_of(i).quickest;
    double decay = course.conduction.fastest_decay(course.position, quickest);
    double through = 0.0;
    for (std::size_t i = 0; i < section.through_coating.size(); ++i)
      if (const NodeIndex over = section.coating_node[i]; exists(over))
        through = std::max(through, 2.0 * section.through_coating[i] *
                                        std::max(1.0 / quickest[i], 1.0 / quickest[index_of(over)]));
    decay += through;
    return decay > 0.0 ? 2.0 / decay : std::numeric_limits<double>::infinity();
  }

  void conduct(const ToolSection<2>& section, Course& course, double interval, Field& temperature) {
    const int substeps = stable_substeps(interval * 2.0 / course.interval.stable);
    for (int s = 0; s < substeps; ++s) {
      std::fill(course.flow.begin(), course.flow.end(), 0.0);
      course.conduction.add_flow(course.position, potential(section, temperature), course.flow);
      for (std::size_t i = 0; i < section.through_coating.size(); ++i) {
        if (!exists(section.coating_node[i])) continue;
        const auto over = index_of(section.coating_node[i]);
        const double inwards = section.through_coating[i] * (temperature[over] - temperature[i]);
        course.flow[i] += inwards;
        course.flow[over] -= inwards;
      }
      for (std::size_t i = 0; i < temperature.size(); ++i)
        warm(section, i, interval / substeps * course.flow[i], temperature);
      hold(section, temperature);
    }
  }

  std::vector<Course> course_;                                         ///< [section]
  std::vector<Passage> passages_;                                      ///< of a section in this step
  Field rate_, potential_;                                             ///< scratch
  Energy content_{"tool_heat_content", EnergyKind::heat_held};         ///< Σ C (T − T_start) of tools
  Energy generated_{"tool_heat_generated", EnergyKind::heat_received}; ///< their share of friction
  Energy exchanged_{"tool_heat_exchanged", EnergyKind::heat_received}; ///< received through held nodes
};

} // namespace

template<> std::unique_ptr<Term<2>> tool_heat(const Model<2>& model) {
  if (model.tool_sections.empty()) return nullptr;
  return std::make_unique<ToolHeat>(model.tool_sections);
}
template<> std::unique_ptr<Term<3>> tool_heat(const Model<3>&) {
  return nullptr;
} // a half-space has no section

} // namespace cnem
