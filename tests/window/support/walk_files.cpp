#include "support/walk_files.h"

namespace tyndall::test {

nlohmann::json walk_of_two_lamps() {
    return nlohmann::json::parse(R"({
        "title": {"eye": [0, 2, 12], "look": [0, 1, 0], "words": "two lamps"},
        "beginning": ["It is dark.", "Light the lamps."],
        "lantern": {"candela": 20, "range": 8, "color": [1, 0.7, 0.4]},
        "night": {"sun": 0.1, "color": [0.6, 0.7, 1], "exposure": -1},
        "hint_after": 40,
        "places": [
            {"name": "the near lamp", "at": [0, 1, 5], "reach": 4,
             "lamps": {"from": [-1, 0, 4], "to": [1, 3, 6]}, "fog": [{"medium": 0, "before": 0}],
             "words": "One burns.", "hint": "Walk on."},
            {"name": "the far lamp", "at": [0, 1, -5], "reach": 4,
             "lamps": {"from": [-1, 0, -6], "to": [1, 3, -4]},
             "words": "Both burn.", "hint": "Behind the near one is another."}],
        "end": {"eye": [0, 4, 14], "look": [0, 1, 0], "words": ["The end."]}
    })");
}

}  // namespace tyndall::test
