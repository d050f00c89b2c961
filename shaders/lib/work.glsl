// Work counters (engine/gl/work_counters.h): COUNT_WORK 1 counts, anything else leaves no text behind.
//
//     count_work(WORK_SHADOW_LOOKUPS, 1u);  // anywhere: adds to a variable of the invocation
//     flush_work();                         // once, where main ends: adds that to the pass's counters
#ifndef TYNDALL_LIB_WORK
#define TYNDALL_LIB_WORK

#include "shaders/shared/bindings.h"

#define WORK_MEDIUM_SAMPLES 0u
#define WORK_SHADOW_LOOKUPS 1u
#define WORK_LIGHT_EVALUATIONS 2u
#define WORK_TEXTURE_FETCHES 3u
#define WORK_TREE_NODES 4u
#define WORK_GRID_READS 5u        // values of density grids, in any level
#define WORK_GRID_LIGHT_READS 6u  // what is stored of what density grids leave of light
#define WORK_GRID_PAGE_READS 7u   // words of their page table
#define WORK_KINDS 8u

#ifndef COUNT_WORK
#define COUNT_WORK 0
#endif

#if COUNT_WORK
struct WorkCounter {
    uint low, high;
};
layout(std430, binding = BINDING_WORK) buffer WorkBuffer { WorkCounter work_total_[WORK_KINDS]; };
uint work_[WORK_KINDS] = uint[WORK_KINDS](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);

void count_work(uint kind, uint n) { work_[kind] += n; }

void flush_work() {
    for (uint kind = 0u; kind < WORK_KINDS; ++kind) {
        uint n = work_[kind];
        if (n == 0u) continue;
        uint before = atomicAdd(work_total_[kind].low, n);
        if (before + n < before) atomicAdd(work_total_[kind].high, 1u);  // a word of 2^32 was passed
    }
}
#else
#define count_work(kind, n)
#define flush_work()
#endif

#endif
