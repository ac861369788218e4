target_sources(nacre PRIVATE transmit/transmit_technique.cpp)
nacre_shader(nacre transmit/transmit.comp NAME transmit TRANSLATED)
