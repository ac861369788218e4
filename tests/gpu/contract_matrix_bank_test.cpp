// The matrix of contract_matrix_test.cpp for technique bank, whose passes take a software device longest to compile.
#include "tests/gpu/support/matrix.hpp"

using namespace nacre::tests;

namespace {

TEST_F(MatrixTest, BankFollowsBrute) {
    expectFollows(NACRE_TECHNIQUE_BANK, 0.03, matrixFormats());
}

} // namespace
