#include "engine/scene/density_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "engine/core/error.h"
#include "engine/core/isolated.h"
#include "engine/grids/nanovdb_reader.h"
#include "engine/grids/vdb_reader.h"
#include "engine/scene/density_grid_builder.h"
#include "engine/scene/volume_texture.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

enum class Part : std::uint32_t { end, transform, brick, tile };

struct BrickPart {
    glm::ivec3 lower;
    grids::BrickValues values;
};
struct TilePart {
    glm::ivec3 lower;
    std::int32_t side;
    float value;
};

class Sender final : public grids::GridSink {
  public:
    explicit Sender(const IsolatedWork::Send& send) : send_(send) {}
    void transform(const glm::dmat4& index_to_grid) override { send(Part::transform, index_to_grid); }
    void brick(const glm::ivec3& lower, const grids::BrickValues& values) override {
        const bool empty = std::ranges::all_of(values, [](float value) { return value == 0; });
        if (!empty) send(Part::brick, BrickPart{lower, values});
    }
    void tile(const glm::ivec3& lower, int side, float value) override {
        send(Part::tile, TilePart{lower, side, value});
    }
    void end() { send_(&end_, sizeof end_); }

  private:
    template <class T>
    void send(Part part, const T& value) {
        send_(&part, sizeof part);
        send_(&value, sizeof value);
    }
    static constexpr Part end_ = Part::end;
    const IsolatedWork::Send& send_;
};

void receive(IsolatedWork& reader, DensityGridBuilder& builder) {
    for (;;) {
        switch (reader.receive<Part>()) {
            case Part::end:
                return;
            case Part::transform:
                builder.transform(reader.receive<glm::dmat4>());
                break;
            case Part::brick: {
                const auto part = reader.receive<BrickPart>();
                builder.brick(part.lower, part.values);
                break;
            }
            case Part::tile: {
                const auto part = reader.receive<TilePart>();
                builder.tile(part.lower, part.side, part.value);
                break;
            }
            default:
                throw Error("damaged: its reader sent garbage");
        }
    }
}

using Reader = void (*)(const fs::path&, const std::string&, grids::GridSink&);

void read_isolated(Reader reader, const fs::path& file, const std::string& name, DensityGridBuilder& builder) {
    constexpr std::uintmax_t largest = std::uintmax_t{1} << 30U;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) throw Error("cannot read: " + error.message());
    if (size > largest) throw Error(fmt::format("too large: {} bytes, at most {} expected", size, largest));
    IsolatedWork work([&](const IsolatedWork::Send& send) {
        Sender sender(send);
        reader(file, name, sender);
        sender.end();
    });
    receive(work, builder);
}

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

std::shared_ptr<const DensityGrid> load_density_grid(const fs::path& file, const std::string& name) {
    try {
        DensityGridBuilder builder;
        const std::string extension = lower_case(file.extension().string());
        if (extension == ".vdb")
            read_isolated(grids::read_vdb, file, name, builder);
        else if (extension == ".nvdb")
            read_isolated(grids::read_nanovdb, file, name, builder);
        else if (extension == ".json")
            read_volume_texture(file, builder);
        else
            throw Error("a name that ends in .vdb, .nvdb or .json expected");
        return std::make_shared<const DensityGrid>(builder.finish());
    } catch (const Error& e) {
        const std::string message = e.what(), path = file.string();
        if (message.starts_with(path)) throw;
        throw Error(fmt::format("{}: {}", path, message));
    }
}

}  // namespace tyndall
