// Every combination of projections, optional inputs and parts of images (stereo among them), in formats of which every
// two meet: techniques against brute, and each against itself in the plainest formats and all of an image.
// contract_matrix_bank_test.cpp has bank.
#include "tests/gpu/support/matrix.hpp"

using namespace nacre::tests;

namespace {

TEST_F(MatrixTest, SeparableFollowsBrute) {
    expectFollows(NACRE_TECHNIQUE_SEPARABLE, 0.04, matrixFormats());
}

TEST_F(MatrixTest, BurleyFollowsBrute) {
    expectFollows(NACRE_TECHNIQUE_BURLEY, 0.08, matrixFormats());
}

// Its radius is in texels: brute is not what it aims at.
TEST_F(MatrixTest, ThesisFollowsItself) {
    expectFollows(NACRE_TECHNIQUE_THESIS, 1, matrixFormats());
}

// The reference reads images by the functions of the others; a software device takes long to compile it.
TEST_F(MatrixTest, BruteFollowsItself) {
    const std::vector<MatrixFormats> all = matrixFormats();
    const MatrixFormats ends[] = {all.front(), all.back()};
    expectFollows(NACRE_TECHNIQUE_BRUTE, 0, ends);
}

} // namespace
