#include "engine/shader/shader_library.h"

namespace tyndall {

std::vector<Permutation> all_permutations(const ProgramDesc& desc) {
    std::vector<Permutation> all{{}};
    for (const PermutationAxis& axis : desc.axes) {
        std::vector<Permutation> longer;
        for (const Permutation& permutation : all)
            for (int value : axis.values) {
                longer.push_back(permutation);
                longer.back()[axis.define] = value;
            }
        all = std::move(longer);
    }
    if (desc.valid) std::erase_if(all, [&](const Permutation& permutation) { return !desc.valid(permutation); });
    return all;
}

namespace {
// Function-local, so that registrations at namespace scope find it made whatever their order.
std::vector<const ProgramDesc*>& registered() {
    static std::vector<const ProgramDesc*> descs;
    return descs;
}
}  // namespace

const std::vector<const ProgramDesc*>& ProgramRegistry::all() {
    return registered();
}
ProgramRegistry::Registration::Registration(const ProgramDesc& desc) {
    registered().push_back(&desc);
}

}  // namespace tyndall
