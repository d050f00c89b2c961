#pragma once

#include <filesystem>
#include <optional>

#include "sample_game/player_settings.h"
#include "sample_game/walk/walk_scene.h"
#include "session/session.h"

namespace tyndall {

/// What a player sees: the title, from which the others are chosen; the walk, which has an end; or the level alone.
enum class Stage { title, walk, explore };

struct GameOptions {
    Stage begin = Stage::explore;
    std::optional<WalkScene> walk = {};               ///< of the scene; without one there is only Stage::explore
    float scale = 1;                                  ///< of the scene: PlayChoice
    double frame_budget = 0;                          ///< ms: PlayChoice; not with a fixed step
    std::string told;                                 ///< shown at first: PlayChoice
    int frames = 0;                                   ///< quit after so many; 0: when the window is closed
    std::optional<std::filesystem::path> screenshot;  ///< taken of the last frame, with what is on screen
    std::optional<std::filesystem::path> stats;       ///< JSON, written at each F2 screenshot and at the end
    decltype(Input::keys_pressed) early_keys;         ///< pressed while it loaded: they count in the first frame
    PlayerSettings player;
    std::filesystem::path player_path;  ///< where they are kept
    double fixed_step = 0;              ///< s; 0: the wall clock
};

/// What the key V chooses: the next technique that a game can run, `off` after the last.
[[nodiscard]] std::string technique_after(const std::string& current);

/// The game's loop, until the window is closed. Keys: README.
void play(Session& session, const GameOptions& options);

}  // namespace tyndall
