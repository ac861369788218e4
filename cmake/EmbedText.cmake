# Script: turns a text file (INPUT) into a C++ header (OUTPUT) with one constexpr std::string_view called SYMBOL.
file(READ "${INPUT}" text)
if(text MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${INPUT} has the mark that ends embedded text")
endif()
# A system header is exempt from the warning about literals longer than C++ compilers have to read.
file(WRITE "${OUTPUT}" "#pragma once\n#pragma GCC system_header\n#include <string_view>\ninline constexpr std::string_view ${SYMBOL} = R\"embedded(${text})embedded\";\n")
