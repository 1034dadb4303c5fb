/* SPDX-License-Identifier: MIT
 *
 * scenario_run - runs the scenarios of a project, and tells what came of each.
 *
 * A program that is built for it, in a thread of its own: the simulation does not know of
 * it. Results are plain values, made in that thread and handed over.
 */
#ifndef EDITOR_SCENARIO_RUN_H
#define EDITOR_SCENARIO_RUN_H

#include "editor-gtk/sim/sim.h"

enum scenario_outcome {
	SCENARIO_HELD,
	SCENARIO_FAILED,     /* an expectation did not hold, or the program stopped  */
	SCENARIO_UNREAD,     /* something in the file is wrong, or in the program    */
};

struct scenario_result {
	enum scenario_outcome outcome;
	char *path;          /* of the file                                    */
	char *name;          /* of the scenario; "": of the file as a whole    */
	char *why;           /* in one line; "": it held                       */
	int first_line;      /* of the scenario; 0: none                       */
	int line, column;    /* that is wrong, 1-based; 0: none                */
	/* Of SCENARIO_FAILED: how to get there, for ladder_sim_play(). */
	guint64 scan;
	gint64 period_ns;
	GArray *acts;
	char *plant;         /* file of the plant beside it; NULL: none        */
};
void scenario_result_free(struct scenario_result *result);

/** scenario_files - paths of a project's scenario files: those beside @path whose names
 * begin as its own does, but those of another program. Caller: g_ptr_array_unref(). */
GPtrArray *scenario_files(const char *path);

/**
 * scenario_run_all - in a thread; @done is called in the main context
 * @program, @len: text of the project   @file: what it is called
 * @files: paths (char *); @texts: what stands in each, NULL: on the disk; both taken over
 * @stop: NULL: nobody stops it
 */
void scenario_run_all(const char *file, const char *program, gsize len, GPtrArray *files,
		      GPtrArray *texts, GCancellable *stop, GAsyncReadyCallback done,
		      gpointer data);
/** scenario_run_finish - of struct scenario_result *; NULL: it was stopped. Caller:
 * g_ptr_array_unref(). */
GPtrArray *scenario_run_finish(GAsyncResult *result);

#endif
