/* SPDX-License-Identifier: MIT
 *
 * scenario_run - runs the scenarios of a project in a thread, and returns a result for each.
 *
 * It builds its own program and does not use the simulation.
 */
#ifndef EDITOR_SCENARIO_RUN_H
#define EDITOR_SCENARIO_RUN_H

#include "editor-gtk/sim/sim.h"

enum scenario_outcome {
	SCENARIO_HELD,
	SCENARIO_FAILED,     /* a value was not as expected, or the program stopped  */
	SCENARIO_UNREAD,     /* the file or the program has an error                 */
};

struct scenario_result {
	enum scenario_outcome outcome;
	char *path;          /* of the file                                    */
	char *name;          /* of the scenario; "": of the file as a whole    */
	char *why;           /* why it failed, one line; "": it held           */
	int first_line;      /* of the scenario; 0: none                       */
	int line, column;    /* of the failure, 1-based; 0: none               */
	/* Of SCENARIO_FAILED: for ladder_sim_play(), to show the failure. */
	guint64 scan;
	gint64 period_ns;
	guint64 speed;       /* of the board; 0: none                          */
	GArray *acts;
	char *plant;         /* file of the plant beside it; NULL: none        */
};

/** scenario_files - paths of a project's scenario files: those beside @path whose names
 * begin as its own does, but those of another program. Caller: g_ptr_array_unref(). */
GPtrArray *scenario_files(const char *path);

/**
 * scenario_run_all - in a thread; @done is called in the main context
 * @reader: of ladder_document_reader(), taken over
 * @program, @len: text of the project   @file: what it is called
 * @files: paths (char *); @texts: the text of each, NULL: read the file; both taken over
 * @stop: cancels it; NULL: cannot be cancelled
 */
void scenario_run_all(struct ladder *reader, const char *file, const char *program, gsize len,
		      GPtrArray *files, GPtrArray *texts, GCancellable *stop,
		      GAsyncReadyCallback done, gpointer data);
/** scenario_run_finish - of struct scenario_result *; NULL: cancelled. Caller:
 * g_ptr_array_unref(). */
GPtrArray *scenario_run_finish(GAsyncResult *result);

#endif
