#include "io/vtu_file.hpp"

#include "core/error.hpp"
#include "io/html.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace cnem::io {
namespace {

static_assert(std::endian::native == std::endian::little, "files say LittleEndian");
constexpr std::size_t block_bytes = std::size_t{1} << 16;

struct Block {
  std::size_t array = 0;
  std::string_view bytes;
  std::string packed;
};

bool deflate_block(Block& block) {
  // The fastest level: mantissas hardly compress at any.
  constexpr int level = 1;
  block.packed.resize(compressBound(static_cast<uLong>(block.bytes.size())));
  auto length = static_cast<uLongf>(block.packed.size());
  const int result = compress2(reinterpret_cast<Bytef*>(block.packed.data()), &length,
                               reinterpret_cast<const Bytef*>(block.bytes.data()),
                               static_cast<uLong>(block.bytes.size()), level);
  block.packed.resize(length);
  return result == Z_OK;
}

void append_number(std::string& text, std::uint64_t value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof value);
}

// Lists arrays with their offsets into the appended data.
class Listing {
public:
  explicit Listing(const VtuArrays& arrays) : arrays_(arrays) {}

  std::string entry(const VtuEntry& entry) {
    const std::string line = fmt::format("        <DataArray type=\"{}\" Name=\"{}\" "
                                         "NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                                         entry.type, html_escape(entry.name), entry.components, offset_);
    order_.push_back(entry.array);
    offset_ += arrays_.packed(entry.array).size();
    return line;
  }
  std::string section(const char* name, const std::vector<VtuEntry>& entries) {
    std::string text = fmt::format("      <{}>\n", name);
    for (const VtuEntry& e : entries) text += entry(e);
    return text + fmt::format("      </{}>\n", name);
  }
  std::string appended() const {
    std::string data;
    data.reserve(offset_);
    for (const std::size_t array : order_) data += arrays_.packed(array);
    return data;
  }

private:
  const VtuArrays& arrays_;
  std::vector<std::size_t> order_;
  std::size_t offset_ = 0;
};

} // namespace

std::size_t VtuArrays::add_bytes(std::string_view bytes) {
  const auto [at, fresh] = known_.emplace(std::pair(bytes.data(), bytes.size()), bytes_.size());
  if (fresh) bytes_.push_back(bytes);
  return at->second;
}

void VtuArrays::compress() {
  std::vector<Block> blocks;
  for (std::size_t a = 0; a < bytes_.size(); ++a)
    for (std::size_t from = 0; from < bytes_[a].size(); from += block_bytes)
      blocks.push_back({a, bytes_[a].substr(from, block_bytes), {}});
  bool whole = true;
  const auto count = static_cast<std::ptrdiff_t>(blocks.size());
#pragma omp parallel for schedule(dynamic) reduction(&& : whole)
  for (std::ptrdiff_t b = 0; b < count; ++b)
    whole = deflate_block(blocks[static_cast<std::size_t>(b)]) && whole;
  if (!whole) throw IoError("cannot compress fields");
  packed_.assign(bytes_.size(), {});
  for (std::size_t a = 0, b = 0; a < bytes_.size(); ++a) {
    std::size_t end = b;
    while (end < blocks.size() && blocks[end].array == a) ++end;
    append_number(packed_[a], end - b);
    append_number(packed_[a], block_bytes);
    append_number(packed_[a], bytes_[a].size() % block_bytes); // of the last block, 0 when it is full
    for (std::size_t k = b; k < end; ++k) append_number(packed_[a], blocks[k].packed.size());
    for (; b < end; ++b) packed_[a] += blocks[b].packed;
  }
}

std::string vtu_text(const VtuGrid& grid, const VtuArrays& arrays) {
  Listing listing(arrays);
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n"
      // TimeValue is the name ParaView looks for.
      "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray>\n    </FieldData>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      grid.time, grid.points, grid.cells);
  xml += listing.section("PointData", grid.point_data);
  xml += listing.section("CellData", grid.cell_data);
  xml += listing.section("Points", {grid.position});
  xml += listing.section("Cells", {grid.connectivity, grid.offsets, grid.types});
  xml += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  return xml + listing.appended() + "\n  </AppendedData>\n</VTKFile>\n";
}

} // namespace cnem::io
