// The validation layer (1.3.239) leaks and is unloaded before the report, so its leaks cannot be recognised by their origin.
extern "C" const char* __asan_default_options();

extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}
