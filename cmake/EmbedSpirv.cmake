# Script: turns SPIR-V words (INPUT) into a C++ header (OUTPUT) with a nacre::EmbeddedShader called SYMBOL, whose name is NAME.
file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1u," words "${hex}")
string(REGEX REPLACE "(0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,0x[0-9a-f]+u,)"
       "\\1\n" words "${words}")
file(WRITE "${OUTPUT}" "#pragma once
#include \"embedded_shader.hpp\"
inline constexpr std::uint32_t ${SYMBOL}_words[] = {
${words}
};
inline constexpr nacre::EmbeddedShader ${SYMBOL}{\"${NAME}\", ${SYMBOL}_words};
")
