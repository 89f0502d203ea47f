// Settings of jemalloc, which serves all memory of the program and of what it loads, such as a Vulkan driver.
//
// Many arrays of some hundred kilobytes to some megabytes come and go in every replicate. With glibc, each of them was fetched
// from the system in pages of 4 KiB, which took a fifth of a run on two cores. Here memory comes in large pages, and what is
// freed stays for ten seconds (the default of jemalloc). One arena holds all of it, that of the largest arrays included, so that
// what one thread frees serves the others; they hardly wait for one another.

#include <jemalloc/jemalloc.h>

const char* malloc_conf = "thp:always,narenas:1,oversize_threshold:0";
