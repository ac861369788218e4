target_sources(nacre PRIVATE transmit/light_parameters.cpp transmit/shadow_decoding.cpp transmit/transmit_technique.cpp)
nacre_shader(nacre transmit/transmit.comp NAME transmit TRANSLATED)
nacre_wgsl(nacre transmit/transmit.wgsl)
