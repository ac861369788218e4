#include "bench/turns.hpp"

namespace nacre::bench {

double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::uint32_t takeTurns(std::span<const Turn> turns, const TurnSettings& settings, const TurnProgress& progress,
                        const std::function<void()>& warm) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < turns.size(); ++i) {
        turns[i].warmUp();
        progress("warming up", i + 1, turns.size());
    }
    warm();
    for (std::uint32_t round = 0; round < settings.rounds; ++round) {
        if (round >= settings.leastRounds && secondsSince(begin) > settings.seconds) {
            return round;
        }
        for (std::size_t part = 0; part < std::size(Turn{}.parts); ++part) {
            for (const Turn& turn : turns) {
                if (turn.parts[part]) {
                    turn.parts[part](round);
                }
            }
        }
        progress("round", round + 1, settings.rounds);
    }
    return settings.rounds;
}

} // namespace nacre::bench
