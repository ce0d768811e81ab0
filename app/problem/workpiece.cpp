#include "app/problem/workpiece.hpp"

#include "clouds/generate.hpp"
#include "clouds/space/generate.hpp"
#include "clouds/space/repeat.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "core/error.hpp"
#include "input/space_domain.hpp"
#include "voronoi/space/bodies.hpp"
#include "voronoi/space/recovery.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace cnem::app {
namespace {

clouds::DomainShape domain_shape(const input::Domain& domain) {
  clouds::DomainShape shape;
  shape.outer = domain.outer;
  for (const input::Hole& hole : domain.holes) shape.holes.push_back(hole.outline);
  shape.cracks.insert(shape.cracks.end(), domain.cracks.begin(), domain.cracks.end());
  shape.cracks.insert(shape.cracks.end(), domain.interfaces.begin(), domain.interfaces.end());
  return shape;
}

/// The grid of a block. Throws clouds::SpacingError when it has too many nodes.
clouds::TetrahedralBlock make_block(const input::Block& block, double spacing, double nodes_limit) {
  using Part = input::Block::Part;
  const bool box = block.shape == input::Block::Shape::box;
  // A cylinder is bent out of a prism over the square [−1, 1]², its half or its quarter.
  const auto [box_low, box_high] = block.bounds();
  const Vec3 low =
      box ? box_low
          : Vec3(block.part == Part::quarter ? 0.0 : -1.0, block.part == Part::whole ? -1.0 : 0.0, 0.0);
  const Vec3 high = box ? box_high : Vec3(1.0, 1.0, block.length);
  const Vec3 scale = box ? Vec3(1.0, 1.0, 1.0) : Vec3(block.radius, block.radius, 1.0);
  const Vec3 boxes = (scale.cwiseProduct(high - low) / spacing).array().round().max(1.0);
  if (const double nodes = (boxes.array() + 1.0).prod(); nodes > nodes_limit)
    throw clouds::SpacingError(
        fmt::format("a spacing of {:.3g} m makes about {:.2g} nodes in this block; expected at most {:.2g}",
                    spacing, nodes, nodes_limit));
  std::array<int, 3> count;
  for (int k = 0; k < 3; ++k) count[index_of(k)] = static_cast<int>(boxes[k]);
  return clouds::tetrahedral_block(high - low, count, [&](const Vec3& at) -> Vec3 {
    const Vec3 x = low + at;
    if (box) return x;
    const Vec2 disc = block.radius * clouds::disc_of_square({x.x(), x.y()});
    return block.centre + Vec3(disc.x(), disc.y(), x.z());
  });
}

} // namespace

template<> Workpiece<2> make_workpiece(const input::Case& input) {
  try {
    clouds::GeneratedCloud generated =
        clouds::generate_cloud(domain_shape(input.domain), input.cloud, input.cloud);
    return {std::move(generated.cloud), input.method.options, std::move(generated.warnings)};
  } catch (const clouds::SpacingError& error) {
    throw input.error("cloud.spacing", error.what());
  } catch (const GeometryError& error) {
    const bool list = input.cloud.pattern == clouds::Pattern::list;
    throw input.error(list ? "cloud.nodes" : "domain", error.what());
  }
}

namespace {

/// Where boxes of a grid are flatter than they are wide because the body is.
void warn_of_thin_walls(const Cloud<3>& cloud, double spacing, std::vector<std::string>& warnings) {
  Vec3 low = cloud.position.front(), high = low;
  for (const Vec3& x : cloud.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  int axis = 0;
  const double thickness = (high - low).minCoeff(&axis);
  if (thickness > spacing * (1.0 - 1e-9)) return;
  warnings.push_back(fmt::format("the domain is {:.3g} m thick along {}, less than the spacing, {:.3g} m: no "
                                 "node stands inside; refine",
                                 thickness, "xyz"[axis], spacing));
}

/// Whether the tetrahedra of the start stay; otherwise each new reference finds its own.
bool keeps_mesh(const input::Case& input) {
  return input.method.name != "cnem" ||
         (input.method.options.cells == scni::CellKind::median && !input.adapt.resample);
}

Workpiece<3> make_grid(const input::Case& input) {
  const input::Block& block = *input.domain.block;
  clouds::TetrahedralBlock made = make_block(block, input.cloud.spacing, input.cloud.nodes_limit);
  const auto faces = block.faces();
  made.cloud.piece_names.assign(faces.begin(), faces.end());
  Workpiece<3> workpiece{std::move(made.cloud), input.method.options, {}};
  warn_of_thin_walls(workpiece.cloud, input.cloud.spacing, workpiece.warnings);
  if (keeps_mesh(input))
    workpiece.options.tetrahedra = std::move(made.tetrahedra);
  else
    workpiece.cloud = voronoi::recover_boundary(workpiece.cloud).cloud;
  return workpiece;
}

Workpiece<3> make_body(const input::Case& input) {
  const clouds::SpaceSpacing spacing{input.cloud.spacing, input.cloud.space_refinements};
  std::vector<std::array<std::string, 2>> periods;
  for (const input::Periodicity& periodic : input.periodic) periods.push_back(periodic.pieces);
  clouds::GeneratedSpaceCloud generated =
      clouds::generate_cloud(input::space_domain(input.domain), spacing, input.cloud.nodes_limit, periods);
  voronoi::RecoveredBoundary recovered = voronoi::recover_boundary(generated.cloud);
  recovered.cloud.body = voronoi::bodies_of(recovered.tetrahedra);
  Workpiece<3> workpiece{std::move(recovered.cloud), input.method.options, std::move(generated.warnings)};
  if (keeps_mesh(input))
    workpiece.options.tetrahedra.assign(recovered.tetrahedra.node.begin(), recovered.tetrahedra.node.end());
  return workpiece;
}

} // namespace

template<> Workpiece<3> make_workpiece(const input::Case& input) {
  const input::Domain& domain = input.domain;
  const char* key = domain.block           ? "domain.block"
                    : domain.faceted       ? "domain.stl"
                    : domain.sweep->turned ? "domain.revolve"
                                           : "domain.extrude";
  try {
    return domain.block && domain.block->grid ? make_grid(input) : make_body(input);
  } catch (const clouds::SpacingError& error) {
    throw input.error("cloud.spacing", error.what());
  } catch (const clouds::RepeatError& error) {
    const auto period = std::ranges::find(input.periodic, error.pieces, &input::Periodicity::pieces);
    throw input.error(fmt::format("periodic.{}.pieces", period->name), error.what());
  } catch (const GeometryError& error) { throw input.error(key, error.what()); }
}

} // namespace cnem::app
