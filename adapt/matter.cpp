#include "adapt/matter.hpp"

#include <algorithm>

namespace cnem::adapt {

namespace {

/// a += factor · b.
void add(Row& a, const Row& b, double factor) {
  Row sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first))
      sum.push_back(*i++);
    else if (i == a.end() || j->first < i->first) {
      sum.emplace_back(j->first, factor * j->second);
      ++j;
    } else {
      sum.emplace_back(i->first, i->second + factor * j->second);
      ++i;
      ++j;
    }
  }
  a = std::move(sum);
}

} // namespace

Matter::Matter(NodeProperties properties) : node_(std::move(properties)), old_nodes_(node_.mass.size()) {
  old_of_.resize(old_nodes_);
  for (const NodeIndex i : old_of_.indices()) old_of_[i] = i;
  parcels_.resize(old_nodes_);
  labels_.resize(old_nodes_);
}

Row& Matter::row(IndexedVector<NodeIndex, Row>& rows, NodeIndex i) {
  Row& mine = rows[i];
  if (mine.empty() && exists(old_of_[i])) mine = {{old_of_[i], 1.0}};
  return mine;
}

void Matter::append(const std::vector<std::pair<NodeIndex, double>>& parents) {
  Row label;
  double size = 0.0;
  for (const auto& [parent, weight] : parents) {
    add(label, row(labels_, parent), weight);
    size += weight * node_.size[index_of(parent)];
  }
  labels_.push_back(std::move(label));
  parcels_.emplace_back();
  node_.mass.push_back(0.0);
  node_.jacobian.push_back(1.0);
  node_.density.push_back(node_.density[index_of(parents.front().first)]);
  node_.size.push_back(size);
  node_.held.push_back(0);
  if (!node_.part.empty()) node_.part.push_back(node_.part[parents.front().first]);
  if (!node_.broken.empty()) {
    double broken = 0.0;
    for (const auto& [parent, weight] : parents) broken += weight * node_.broken[index_of(parent)];
    node_.broken.push_back(broken);
  }
  old_of_.push_back(NodeIndex::none);
}

void Matter::move(const std::vector<Parcel>& parcels) {
  std::vector<std::pair<NodeIndex, double>> left; // donor and what has left it
  for (const Parcel& parcel : parcels) {
    const std::size_t from = index_of(parcel.from), to = index_of(parcel.to);
    const double mass = parcel.fraction * node_.mass[from];
    const double total = node_.mass[to] + mass;
    node_.jacobian[to] = (node_.jacobian[to] * node_.mass[to] + node_.jacobian[from] * mass) / total;
    node_.mass[to] = total;
    add(row(parcels_, parcel.to), row(parcels_, parcel.from), parcel.fraction);
    left.emplace_back(parcel.from, parcel.fraction);
  }
  std::stable_sort(left.begin(), left.end(), [](auto& a, auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < left.size();) {
    const std::size_t from = index_of(left[k].first);
    double gone = 0.0;
    for (; k < left.size() && index_of(left[k].first) == from; ++k) gone += left[k].second;
    node_.mass[from] *= 1.0 - gone;
    for (auto& entry : row(parcels_, as<NodeIndex>(from))) entry.second *= 1.0 - gone;
  }
}

void Matter::move_now(NodeIndex from, NodeIndex to, double fraction) { move({{from, to, fraction}}); }

IndexedVector<NodeIndex, NodeIndex> numbers_without(const IndexedVector<NodeIndex, char>& gone) {
  IndexedVector<NodeIndex, NodeIndex> number(gone.size(), NodeIndex::none);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) number[i] = as<NodeIndex>(kept++);
  return number;
}

void Matter::renumber(const IndexedVector<NodeIndex, NodeIndex>& number) {
  adapt::renumber(number, node_.mass);
  adapt::renumber(number, node_.jacobian);
  adapt::renumber(number, node_.density);
  adapt::renumber(number, node_.size);
  adapt::renumber(number, node_.held);
  if (!node_.broken.empty()) adapt::renumber(number, node_.broken);
  if (!node_.part.empty()) adapt::renumber(number, node_.part);
  adapt::renumber(number, old_of_);
  adapt::renumber(number, parcels_);
  adapt::renumber(number, labels_);
}

bool Matter::came_or_went() const {
  return old_of_.size() != old_nodes_ ||
         std::find(old_of_.begin(), old_of_.end(), NodeIndex::none) != old_of_.end();
}

NodeRows Matter::rows_of_nodes(const IndexedVector<NodeIndex, Row>& rows) const {
  NodeRows result;
  result.begin.reserve(rows.size() + 1);
  result.begin.push_back(0);
  for (const NodeIndex i : rows.indices()) {
    if (rows[i].empty() && exists(old_of_[i])) { // as most are
      result.from.push_back(old_of_[i]);
      result.weight.push_back(1.0);
    }
    for (const auto& [node, weight] : rows[i]) {
      result.from.push_back(node);
      result.weight.push_back(weight);
    }
    result.begin.push_back(as<std::int32_t>(result.from.size()));
  }
  return result;
}

template<int dim> Resampling<dim> Matter::finished(const Cloud<dim>& cloud) const {
  Resampling<dim> result;
  result.cloud = cloud;
  result.parcels = rows_of_nodes(parcels_);
  result.labels = rows_of_nodes(labels_);
  result.old_of = old_of_;
  result.new_of.assign(old_nodes_, NodeIndex::none);
  for (const NodeIndex i : old_of_.indices())
    if (exists(old_of_[i])) result.new_of[old_of_[i]] = i;
  return result;
}
template Resampling<2> Matter::finished(const Cloud<2>&) const;
template Resampling<3> Matter::finished(const Cloud<3>&) const;

} // namespace cnem::adapt
