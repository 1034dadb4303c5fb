/* SPDX-License-Identifier: MIT
 *
 * options - the arguments of ladderd, as values. Prints and checks no file.
 */
#ifndef LADDERD_OPTIONS_H
#define LADDERD_OPTIONS_H

#include "ladderd/store.h"

#include <stdbool.h>
#include <stdint.h>

struct options {
	const char *file, *map;
	int64_t period_ns;     /* 0: not given                                */
	int64_t watchdog;      /* periods                                     */
	uint64_t scans;        /* 0: for ever                                 */
	int priority;          /* 0: none                                     */
	struct store_wish retain; /* path NULL: no                            */
	bool check, trace_io, attended, help, version;
	const char *wrong;     /* the argument that is                        */
	const char *why;       /* what is wrong with it                       */
};

/** options_read - Fails: false; `wrong` and `why` are set. Scan-safe: no. */
bool options_read(struct options *options, int argc, char **argv);
/** options_help - the text of --help. Lives for ever. */
const char *options_help(void);
#endif
