target_sources(nacre PRIVATE baselines/brute/brute_technique.cpp)
nacre_shader(nacre baselines/brute/scatter_brute_pixels.comp NAME scatter_brute_pixels TRANSLATED)
nacre_shader(nacre baselines/brute/scatter_brute_gather.comp NAME scatter_brute_gather TRANSLATED)
