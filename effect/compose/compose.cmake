target_sources(nacre PRIVATE compose/compose_technique.cpp)
nacre_shader(nacre compose/compose_sum.comp NAME compose TRANSLATED)
