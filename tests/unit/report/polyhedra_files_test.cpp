// Surface and polyhedra in files of fields, as VTK reads them.
#include "clouds/tetrahedral_block.hpp"
#include "core/index.hpp"
#include "results/vtk_writer.hpp"
#include "tests/temporary_folder.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cnem::results {
namespace {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

Grid read(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

Vec3 place(vtkUnstructuredGrid& grid, vtkIdType point) {
  Vec3 x;
  grid.GetPoint(point, x.data());
  return x;
}

/// m³, by fans of its faces.
double volume_of(vtkUnstructuredGrid& grid) {
  double sum = 0.0;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    vtkNew<vtkIdList> faces;
    grid.GetFaceStream(c, faces);
    vtkIdType at = 1;
    for (vtkIdType f = 0; f < faces->GetId(0); ++f) {
      const vtkIdType corners = faces->GetId(at);
      const auto corner = [&](vtkIdType k) { return place(grid, faces->GetId(at + 1 + k)); };
      for (vtkIdType k = 2; k < corners; ++k) sum += corner(0).dot(corner(k - 1).cross(corner(k))) / 6.0;
      at += corners + 1;
    }
  }
  return sum;
}

TEST(PolyhedraFiles, enclose_the_body_and_carry_the_values_of_nodes) {
  const testing::TemporaryFolder folder("polyhedra_files");
  const clouds::TetrahedralBlock block = clouds::tetrahedral_block({2, 1, 1}, {4, 3, 3});
  Fields<3> position;
  for (const Vec3& x : block.cloud.position)
    for (std::size_t k = 0; k < 3; ++k) position[k].push_back(x[static_cast<Eigen::Index>(k)]);
  CellGeometry<3> none;
  FileQueue queue;
  FieldWriter writer(folder.path());
  for (const PolyhedraOf kind : {PolyhedraOf::median_cells, PolyhedraOf::voronoi_cells}) {
    const auto frame = std::make_shared<FieldFrame<3>>();
    frame->time = writer.frames();
    frame->cells = &none;
    frame->position = {position[0], position[1], position[2]};
    frame->node_scalars = {{"x [m]", position[0]}};
    frame->node_vectors = {{"place [m]", {position[0], position[1], position[2]}}};
    frame->polyhedra = polyhedra(kind, block.cloud, block.tetrahedra, position);
    for (const Facet<3>& facet : block.cloud.facets) frame->surface.push_back(facet.node);
    writer.write<3>(queue, frame);
  }
  queue.wait();
  const auto series = read_field_series(folder.path());
  ASSERT_EQ(series.size(), 2U);
  for (const FieldFiles& files : series) {
    ASSERT_EQ(files.parts.size(), 2U);
    const Grid surface = read(folder.path() / files.parts[0].file),
               cells = read(folder.path() / files.parts[1].file);
    ASSERT_EQ(cells->GetNumberOfCells(), static_cast<vtkIdType>(block.cloud.position.size()));
    EXPECT_NEAR(volume_of(*cells), 2.0, 1e-12);
    EXPECT_EQ(cells->GetCellData()->GetArray("x [m]")->GetComponent(7, 0), position[0][7]);
    EXPECT_EQ(cells->GetCellData()->GetArray("place [m]")->GetComponent(7, 2), position[2][7]);
    ASSERT_EQ(surface->GetNumberOfCells(), static_cast<vtkIdType>(block.cloud.facets.size()));
    EXPECT_LT(surface->GetNumberOfPoints(), static_cast<vtkIdType>(block.cloud.position.size()));
    double enclosed = 0.0;
    vtkNew<vtkIdList> corner;
    for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c) {
      surface->GetCellPoints(c, corner);
      const Vec3 a = place(*surface, corner->GetId(0)), b = place(*surface, corner->GetId(1)),
                 d = place(*surface, corner->GetId(2));
      enclosed += a.dot(b.cross(d)) / 6.0;
    }
    EXPECT_NEAR(enclosed, 2.0, 1e-12);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
      EXPECT_EQ(surface->GetPointData()->GetArray("x [m]")->GetComponent(i, 0), place(*surface, i).x());
  }
}

} // namespace
} // namespace cnem::results
