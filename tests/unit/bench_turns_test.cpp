// The order in which the benchmark measures.
#include "bench/turns.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace nacre::bench;

namespace {

class TurnsTest : public testing::Test {
protected:
    Turn named(const std::string& name, bool second) {
        const auto part = [this](const std::string& what) {
            return [this, what](std::uint32_t round) { log_ += what + std::to_string(round) + ' '; };
        };
        Turn turn{[this, name] { log_ += "warm-" + name + ' '; }, {part(name)}};
        if (second) {
            turn.parts[1] = part(name + "'");
        }
        return turn;
    }

    std::uint32_t take(const std::vector<Turn>& turns, const TurnSettings& settings) {
        return takeTurns(
            turns, settings,
            [this](const char* what, std::size_t done, std::size_t all) {
                progress_.push_back(what + (" " + std::to_string(done) + "/" + std::to_string(all)));
            },
            [this] { log_ += "| "; });
    }

    std::string log_;
    std::vector<std::string> progress_;
};

TEST_F(TurnsTest, GoRoundPartByPart) {
    EXPECT_EQ(take({named("a", true), named("b", true), named("c", false)}, {.rounds = 2, .leastRounds = 2}), 2u);
    EXPECT_EQ(log_, "warm-a warm-b warm-c | a0 b0 c0 a'0 b'0 a1 b1 c1 a'1 b'1 ");
    EXPECT_EQ(progress_, (std::vector<std::string>{"warming up 1/3", "warming up 2/3", "warming up 3/3", "round 1/2",
                                                   "round 2/2"}));
}

TEST_F(TurnsTest, EndWithTheTimeButNotBeforeTheLeastRounds) {
    EXPECT_EQ(take({named("a", false)}, {.rounds = 9, .leastRounds = 3, .seconds = 0}), 3u);
    EXPECT_EQ(log_, "warm-a | a0 a1 a2 ");
    EXPECT_EQ(take({named("a", false)}, {.rounds = 9, .leastRounds = 3, .seconds = 3600}), 9u);
}

} // namespace
