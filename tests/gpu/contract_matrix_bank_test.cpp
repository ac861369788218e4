// The matrix of contract_matrix_test.cpp for techniques bank and bank-surfaces, whose passes take a software device
// longest to compile.
#include "tests/gpu/support/matrix.hpp"

using namespace nacre::tests;

namespace {

TEST_F(MatrixTest, BankFollowsBrute) {
    expectFollows(NACRE_TECHNIQUE_BANK, 0.03, matrixFormats());
}

// It reads and writes images as bank does.
TEST_F(MatrixTest, BankSurfacesFollowsBrute) {
    const std::vector<MatrixFormats> all = matrixFormats();
    const MatrixFormats ends[] = {all.front(), all.back()};
    expectFollows(NACRE_TECHNIQUE_BANK_SURFACES, 0.03, ends);
}

} // namespace
