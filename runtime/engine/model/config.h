/* SPDX-License-Identifier: MIT
 *
 * config - a CONFIGURATION: tasks, the programs they run, sizes of areas (IEC 61131-3,
 * 2.7 and tables 49 and 50).
 *
 * As it was written, line by line. check/ resolves the names, scan/ decides when a task
 * runs.
 */
#ifndef MODEL_CONFIG_H
#define MODEL_CONFIG_H

#include "engine/base/iec.h"

enum config_kind { CONFIG_VARS, CONFIG_AREA, CONFIG_TASK, CONFIG_PROGRAM };

/* One line; members of other kinds are 0. */
struct config_entry {
	enum config_kind kind;
	bool inside;          /* of the RESOURCE                              */
	uint32_t name;        /* TASK, PROGRAM: string id                     */
	uint32_t pou, task;   /* PROGRAM: string ids; task 0: none            */
	uint32_t single;      /* TASK: string id of an operand; 0: none       */
	int64_t interval_ns, watchdog_ns; /* TASK; 0: none                    */
	uint32_t interval, watchdog;      /* string ids, as written           */
	uint32_t priority;    /* TASK: 0 is the highest                       */
	enum iec_area area;   /* AREA                                         */
	uint32_t bytes;       /* AREA: its size                               */
	int block;            /* VARS: index of a block of the globals        */
	uint32_t comment;     /* its comment                                  */
	int line;
};

struct config {
	uint32_t name;
	uint32_t comment;     /* the comment of its first line                */
	bool has_resource;
	uint32_t resource, on; /* string ids; on 0: not written               */
	uint32_t resource_comment;
	struct config_entry *entry;
	int count;
	const char *file;     /* it stands in; borrowed from the arena        */
	int line;
};
#endif
