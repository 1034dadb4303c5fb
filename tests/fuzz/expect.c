/* SPDX-License-Identifier: MIT
 *
 * expect - how a fuzz target says that a promise was broken.
 */
#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>

void fuzz_expect(int promise, const char *text)
{
	if (promise)
		return;
	fprintf(stderr, "# broken: %s\n", text);
	abort();
}
