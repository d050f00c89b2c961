#include "tools/modeling/files.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace tyndall::modeling {

bool write_file(const std::string& path, const std::string& bytes) {
    const std::string temporary = path + ".partial";
    std::error_code error;
    {
        std::ofstream out(temporary, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (out) std::filesystem::rename(temporary, path, error);
        if (out && !error) return true;
    }
    std::filesystem::remove(temporary, error);
    return false;
}

std::optional<std::string> read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return std::nullopt;
    return std::string{std::istreambuf_iterator<char>(in), {}};
}

}  // namespace tyndall::modeling
