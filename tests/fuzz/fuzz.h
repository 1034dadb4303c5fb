/* SPDX-License-Identifier: MIT
 *
 * fuzz - the entry of a fuzz target, and its seeds.
 *
 * Each target is one file. It is linked once with libFuzzer and once with replay.c, which
 * needs only a C compiler.
 */
#ifndef FUZZ_FUZZ_H
#define FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>

/** Runs one input of any bytes. Must not crash, leak or hang. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len);

/** fuzz_seed - makes an input from a file of the corpus; malloc'ed. NULL: the file
 * itself is the input. */
uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len);

/** fuzz_expect - stops the program with a message if a promise is broken. */
void fuzz_expect(int promise, const char *text);
#endif
