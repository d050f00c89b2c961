#pragma once

#include <cstdlib>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "engine/shader/shader_library.h"

namespace tyndall::test {

/// Of `all` permutations few that hold each pair of values of two axes which one of all holds: a fault of two
/// defines together shows in one of them. Each time the one with the most new pairs.
inline std::vector<Permutation> covering_permutations(const std::vector<Permutation>& all) {
    using Pair = std::tuple<std::string, int, std::string, int>;
    std::set<Pair> covered;
    const auto new_pairs = [&](const Permutation& permutation) {
        std::set<Pair> pairs;
        for (auto a = permutation.begin(); a != permutation.end(); ++a)
            for (auto b = a; b != permutation.end(); ++b) {
                const Pair pair{a->first, a->second, b->first, b->second};
                if (!covered.contains(pair)) pairs.insert(pair);
            }
        return pairs;
    };
    std::vector<Permutation> chosen;
    for (;;) {
        std::set<Pair> best;
        const Permutation* best_permutation = nullptr;
        for (const Permutation& permutation : all)
            if (std::set<Pair> pairs = new_pairs(permutation); !best_permutation || pairs.size() > best.size()) {
                best = std::move(pairs);
                best_permutation = &permutation;
            }
        // A permutation without axes has no pair and is all there is.
        if (!best_permutation || (best.empty() && !chosen.empty())) return chosen;
        chosen.push_back(*best_permutation);
        covered.merge(best);
    }
}

/// What tests build of a program: all of its permutations where the variable TYNDALL_ALL_PERMUTATIONS is set.
inline std::vector<Permutation> permutations_to_build(const std::vector<Permutation>& all) {
    return std::getenv("TYNDALL_ALL_PERMUTATIONS") ? all : covering_permutations(all);
}

}  // namespace tyndall::test
