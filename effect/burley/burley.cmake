target_sources(nacre PRIVATE burley/burley_technique.cpp)
nacre_shader(nacre burley/scatter_burley.comp NAME scatter_burley TRANSLATED)
