// The one harness of the benchmark: things that are measured in turn, so that a drift of clocks or temperature meets
// all of them alike.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace nacre::bench {

/// One line on what is being done. May throw to end the work early.
using Reporter = std::function<void(const std::string&)>;

double secondsSince(std::chrono::steady_clock::time_point begin);

/// Something to measure. Every part is called once a round: of all things the first part in turn, then of all things
/// the second.
struct Turn {
    std::function<void()> warmUp;                      ///< once, before the first round
    std::function<void(std::uint32_t round)> parts[2]; ///< either may be empty
};

struct TurnSettings {
    std::uint32_t rounds = 13;
    std::uint32_t leastRounds = 13; ///< even where the time is up
    double seconds = 0;             ///< no further round begins this long after the call
};

/// Called after each warm-up and each round: "warming up" or "round", how many are done, of how many.
using TurnProgress = std::function<void(const char* what, std::size_t done, std::size_t all)>;

/// Warms everything up, calls `warm` once that is done, and then goes round. Returns the number of rounds.
std::uint32_t takeTurns(
    std::span<const Turn> turns, const TurnSettings& settings, const TurnProgress& progress,
    const std::function<void()>& warm = [] {});

} // namespace nacre::bench
