/* SPDX-License-Identifier: MIT
 *
 * options - the arguments of ladderd as values. It prints nothing and opens no file.
 */
#ifndef LADDERD_OPTIONS_H
#define LADDERD_OPTIONS_H

#include "ladderd/store.h"

#include <stdbool.h>
#include <stdint.h>

struct options {
	const char *file, *map;
	const char *link;      /* path of the socket for desks; NULL: none    */
	const char *serial;    /* TTY,BAUD for desks; NULL: none              */
	const char *serial_role;
	const char *slots;     /* folder of downloaded programs; NULL: none   */
	const char *groups;    /* where names of groups come from             */
	int64_t record_kb;     /* of --record; 0: none                        */
	int64_t period_ns;     /* 0: not given                                */
	int64_t watchdog;      /* periods                                     */
	int64_t late;          /* late scans in a row that are an event       */
	int64_t scans;         /* 0: no limit                                 */
	int64_t priority;      /* 0: none                                     */
	char name[64];         /* of the board; "": that of the map           */
	struct store_wish retain; /* path NULL: no --retain                   */
	bool no_pm_qos;        /* --rt leaves idle states alone               */
	bool check, trace_io, attended, help, version;
	const char *wrong;     /* the wrong argument                          */
	const char *why;       /* what is wrong with it                       */
	bool full_scan;        /* each scan runs the whole program            */
};

/** options_read - Scan-safe: no. Fails: false; sets `wrong` and `why`. */
bool options_read(struct options *options, int argc, char **argv);
/** options_set - sets the option @name, such as "--period", in the same way. Fails: false: out of
 * range, or no such option. */
bool options_set(struct options *options, const char *name, const char *value);
/** options_help - the text of --help. */
const char *options_help(void);
#endif
