// The published JSON schemas, held against what the command writes.
#pragma once

#include <string>

namespace nacre::test {

/// Asserts that the JSON text is valid under docs/schemas/<schema>, naming every fault.
void expectMatchesSchema(const std::string& text, const std::string& schema);

} // namespace nacre::test
