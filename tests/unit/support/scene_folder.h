#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "engine/core/files.h"
#include "engine/scene/scene.h"
#include "tests/unit/support/gltf_builder.h"

namespace tyndall {

/// A test with a folder of its own for scene files.
class SceneFolderTest : public testing::Test {
  protected:
    SceneFolderTest()
        : folder(std::filesystem::temp_directory_path() / ("tyndall_scene_test." + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder / "scene");
    }
    ~SceneFolderTest() override { std::filesystem::remove_all(folder); }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        write_text(folder / "scene" / name, content);
        return folder / "scene" / name;
    }
    Scene load(const GltfBuilder& builder) const { return load_gltf(write("scene.gltf", builder.text())); }

    const std::filesystem::path folder;
};

}  // namespace tyndall
