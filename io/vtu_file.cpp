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
  bool real = false;
  std::string_view bytes;
  std::string packed;
};

// Mantissas repeat nothing but bytes: looking for runs alone takes half the time of level 1 and leaves a
// twentieth more.
bool deflate_block(Block& block) {
  z_stream stream{};
  const int strategy = block.real ? Z_RLE : Z_DEFAULT_STRATEGY;
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, strategy) != Z_OK)
    return false;
  block.packed.resize(deflateBound(&stream, static_cast<uLong>(block.bytes.size())));
  stream.next_in =
      reinterpret_cast<Bytef*>(const_cast<char*>(block.bytes.data())); // zlib does not write there
  stream.avail_in = static_cast<uInt>(block.bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(block.packed.data());
  stream.avail_out = static_cast<uInt>(block.packed.size());
  const int result = deflate(&stream, Z_FINISH);
  block.packed.resize(stream.total_out);
  deflateEnd(&stream);
  return result == Z_STREAM_END;
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

std::size_t VtuArrays::add_bytes(std::string_view bytes, bool real) {
  const auto [at, fresh] = known_.emplace(std::pair(bytes.data(), bytes.size()), bytes_.size());
  if (fresh) bytes_.push_back(bytes);
  if (fresh) real_.push_back(real);
  return at->second;
}

void VtuArrays::compress() {
  std::vector<Block> blocks;
  for (std::size_t a = 0; a < bytes_.size(); ++a)
    for (std::size_t from = 0; from < bytes_[a].size(); from += block_bytes)
      blocks.push_back({a, real_[a], bytes_[a].substr(from, block_bytes), {}});
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
