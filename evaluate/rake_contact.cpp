#include "evaluate/rake_contact.hpp"

#include "core/fields/vector_at.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

constexpr double bin_of_feed = 0.05, stretch_of_feed = 0.5;
constexpr double reach_of_face = 8.0; ///< feeds of the rake face are looked at
constexpr double all_but = 0.99;      ///< of the normal force acts within the contact length

constexpr std::array lists_of_sums{&RakeSums::normal, &RakeSums::shear, &RakeSums::temperature,
                                   &RakeSums::slip, &RakeSums::edge};

} // namespace

RakeSums& RakeSums::operator+=(const RakeSums& other) {
  duration += other.duration;
  for (const auto list : lists_of_sums)
    for (std::size_t k = 0; k < (this->*list).size(); ++k) (this->*list)[k] += (other.*list)[k];
  return *this;
}

RakeContact::RakeContact(const input::CuttingTool& cut, ToolIndex tool, double feed)
    : cut_(cut), tool_(tool), bin_(bin_of_feed * feed), stretch_(stretch_of_feed * feed),
      recent_(index_of(std::lround(reach_of_face / bin_of_feed))) {}

void RakeContact::add_step(const ExplicitSolver<2>& solver) {
  const State<2>& state = solver.state();
  const auto& contact = solver.conditions().contact;
  const double duration = state.time - last_time_;
  last_time_ = state.time;
  const Vec2 moved = contact.displacement(index_of(tool_), state.time);
  const auto stretch = index_of(static_cast<std::ptrdiff_t>(std::max(0.0, moved.dot(cut_.along)) / stretch_));
  const std::size_t bins = recent_.normal.size();
  while (stretches_.size() <= stretch) stretches_.emplace_back(bins);
  RakeSums& sums = stretches_[stretch];
  sums.duration += duration;
  recent_.duration += duration;

  const Vec2 speed = cut_.turned(contact.velocity(index_of(tool_), state.time));
  const Vec2 face = cut_.face(), normal = cut_.normal();
  const auto& boundary = contact.boundary_nodes();
  for (const auto& point : contact.points()) {
    if (point.tool != tool_) continue;
    const std::size_t i = index_of(point.node);
    const Vec2 x = cut_.place(vector_at<2>(state.node.position, i), moved);
    const double s = x.dot(face);
    const auto b = std::lower_bound(boundary.begin(), boundary.end(), point.node) - boundary.begin();
    const Vec2 impulse = cut_.turned(contact.nodal_impulse()[as<BoundaryNodeIndex>(b)]);
    if (s < cut_.begin || s > cut_.end) {
      for (RakeSums* one : {&sums, &recent_}) {
        one->edge[0] += impulse.x();
        one->edge[1] -= impulse.y();
      }
      continue;
    }
    const double pressing = impulse.dot(normal), drag = -impulse.dot(face);
    const double slip = (cut_.turned(vector_at<2>(state.node.velocity, i)) - speed).dot(face);
    // Spread over the part of the boundary that is the node's.
    const double from = std::max(0.0, s - 0.5 * point.area), to = std::max(from, s + 0.5 * point.area);
    for (auto k = index_of(static_cast<std::ptrdiff_t>(from / bin_));
         k < bins && static_cast<double>(k) * bin_ < to; ++k) {
      const double low = std::max(from, static_cast<double>(k) * bin_),
                   high = std::min(to, static_cast<double>(k + 1) * bin_), share = (high - low) / (to - from);
      for (RakeSums* one : {&sums, &recent_}) {
        one->normal[k] += share * pressing;
        one->shear[k] += share * drag;
        one->temperature[k] += share * pressing * state.node.temperature[i];
        one->slip[k] += share * pressing * slip;
      }
    }
  }
}

RakeFace RakeContact::face_of(const RakeSums& sums) const {
  RakeFace face;
  double total = 0.0, heat = 0.0, within = 0.0;
  for (std::size_t k = 0; k < sums.normal.size(); ++k) {
    const double impulse = sums.normal[k];
    face.at.push_back((static_cast<double>(k) + 0.5) * bin_);
    face.normal.push_back(sums.duration > 0.0 ? impulse / (sums.duration * bin_) : 0.0);
    face.shear.push_back(sums.duration > 0.0 ? sums.shear[k] / (sums.duration * bin_) : 0.0);
    face.temperature.push_back(impulse > 0.0 ? sums.temperature[k] / impulse : unknown);
    face.slip.push_back(impulse > 0.0 ? sums.slip[k] / impulse : unknown);
    total += impulse;
    heat += sums.temperature[k];
  }
  if (sums.duration > 0.0) {
    face.edge_Fc = sums.edge[0] / sums.duration;
    face.edge_Ft = sums.edge[1] / sums.duration;
  }
  if (!(total > 0.0)) return face;
  face.mean_temperature = heat / total;
  for (std::size_t k = 0; k < sums.normal.size(); ++k) {
    const double next = within + sums.normal[k];
    if (next >= all_but * total) {
      face.contact_length = bin_ * (static_cast<double>(k) + (all_but * total - within) / sums.normal[k]);
      break;
    }
    within = next;
  }
  return face;
}

RakeFace RakeContact::take_recent() {
  RakeFace face = face_of(recent_);
  recent_ = RakeSums(recent_.normal.size());
  return face;
}

RakeFace RakeContact::mean(double from, double to) const {
  RakeSums sums(recent_.normal.size());
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    const double middle = (static_cast<double>(k) + 0.5) * stretch_;
    if (middle >= from && middle <= to) sums += stretches_[k];
  }
  return face_of(sums);
}

void RakeContact::archive(Archive& archive) {
  const std::string at = "run/cutting/rake/";
  archive.number(at + "last_time", "s", last_time_);
  auto count = static_cast<std::int64_t>(stretches_.size());
  archive.integer(at + "stretches", count);
  stretches_.resize(index_of(count), RakeSums(recent_.normal.size()));
  std::vector<double> all; // one list: there may be many stretches
  const auto each = [&](auto&& carry) {
    const auto of = [&](RakeSums& sums) {
      carry(sums.duration);
      for (const auto list : lists_of_sums)
        for (double& value : sums.*list) carry(value);
    };
    of(recent_);
    for (RakeSums& sums : stretches_) of(sums);
  };
  each([&](double& value) { all.push_back(value); });
  archive.list(at + "sums", "SI", all);
  std::size_t k = 0;
  each([&](double& value) { value = all[k++]; });
}

} // namespace cnem::evaluate
