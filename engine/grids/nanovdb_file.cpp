#include "engine/grids/nanovdb_file.h"

#include <blosc.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanovdb/util/IO.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "engine/grids/grid_sink.h"

namespace tyndall::grids {
namespace {

using nanovdb::io::Codec;

constexpr std::size_t chunk_size = std::size_t{1} << 30U;  ///< what NanoVDB compresses at once with Blosc

/// A file that never gives more than it holds.
class Input {
  public:
    explicit Input(const std::filesystem::path& path)
        : stream_(path, std::ios::binary), left_(std::filesystem::file_size(path)) {}

    [[nodiscard]] std::uint64_t left() const { return left_; }
    void require(std::uint64_t size) const {
        if (size > left_) throw Unreadable("damaged: it ends too early");
    }
    void read(void* to, std::uint64_t size) {
        require(size);
        if (!stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(size)))
            throw Unreadable("it cannot be read to its end");
        left_ -= size;
    }
    template <class T>
    T read() {
        alignas(T) std::byte bytes[sizeof(T)];
        read(bytes, sizeof bytes);
        T value;
        std::memcpy(static_cast<void*>(&value), bytes, sizeof bytes);
        return value;
    }
    void skip(std::uint64_t size) {
        require(size);
        stream_.seekg(static_cast<std::streamoff>(size), std::ios::cur);
        left_ -= size;
    }
    /// Data behind its length of 8 bytes.
    std::vector<std::byte> read_compressed() {
        const auto size = read<std::uint64_t>();
        require(size);
        std::vector<std::byte> bytes(size);
        read(bytes.data(), size);
        return bytes;
    }

  private:
    std::ifstream stream_;
    std::uint64_t left_;
};

struct Entry {
    nanovdb::io::MetaData data;
    std::string name;
};

/// The head of a segment: its codec, and what it says of its grids. None at the end of the file.
struct Segment {
    Codec codec;
    std::vector<Entry> entries;
};

std::optional<Segment> read_segment(Input& input) {
    if (input.left() == 0) return {};
    const auto head = input.read<nanovdb::io::Header>();
    if (head.magic != NANOVDB_MAGIC_NUMBER) throw Unreadable("it is not a NanoVDB file");
    if (head.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
        throw Unreadable(fmt::format("it is of NanoVDB version {}, version {} expected", head.version.getMajor(),
                                     NANOVDB_MAJOR_VERSION_NUMBER));
    if (head.codec >= Codec::END)
        throw Unreadable(fmt::format("its compression {} is unknown", static_cast<int>(head.codec)));
    Segment segment{head.codec, {}};
    for (int i = 0; i < head.gridCount; ++i) {
        Entry entry{input.read<nanovdb::io::MetaData>(), {}};
        input.require(entry.data.nameSize);
        entry.name.resize(entry.data.nameSize);
        input.read(entry.name.data(), entry.name.size());
        entry.name.resize(std::min(entry.name.size(), entry.name.find('\0')));
        segment.entries.push_back(std::move(entry));
    }
    return segment;
}

void unzip(Input& input, std::span<std::byte> to) {
    const std::vector<std::byte> from = input.read_compressed();
    uLongf size = to.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(to.data()), &size,
                                  reinterpret_cast<const Bytef*>(from.data()), from.size());
    if (status != Z_OK || size != to.size()) throw Unreadable("damaged: its zip data cannot be unpacked");
}

void unblosc(Input& input, std::span<std::byte> to) {
    while (!to.empty()) {
        const std::vector<std::byte> from = input.read_compressed();
        const std::size_t size = std::min(to.size(), chunk_size);
        std::size_t held = 0;
        constexpr int threads = 1;
        if (blosc_cbuffer_validate(from.data(), from.size(), &held) < 0 || held != size ||
            blosc_decompress_ctx(from.data(), to.data(), size, threads) != static_cast<int>(size))
            throw Unreadable("damaged: its Blosc data cannot be unpacked");
        to = to.subspan(size);
    }
}

NanoBuffer read_grid(Input& input, Codec codec, std::uint64_t size) {
    // No codec of these packs more than a thousand to one: sizes beyond are not true.
    constexpr std::uint64_t most_packed = 1100;
    if (size < sizeof(nanovdb::GridData) || size / most_packed > input.left())
        throw Unreadable("damaged: the size of its grid is wrong");
    NanoBuffer buffer(size);
    switch (codec) {
        case Codec::ZIP:
            unzip(input, buffer.bytes());
            break;
        case Codec::BLOSC:
            unblosc(input, buffer.bytes());
            break;
        default:
            input.read(buffer.bytes().data(), size);
    }
    return buffer;
}

}  // namespace

NanoBuffer read_nanovdb_grid(const std::filesystem::path& path, const std::string& name) {
    Input input(path);
    std::vector<std::string> names;
    if (input.left() == 0) throw Unreadable("it is empty");
    while (const auto segment = read_segment(input)) {
        for (const Entry& entry : segment->entries) {
            if (entry.name == name) return read_grid(input, segment->codec, entry.data.gridSize);
            input.skip(entry.data.fileSize);
            names.push_back('"' + entry.name + '"');
        }
    }
    throw Unreadable(fmt::format("no grid \"{}\"; there {}: {}", name, names.size() == 1 ? "is" : "are",
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace tyndall::grids
