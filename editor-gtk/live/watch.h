/* SPDX-License-Identifier: MIT
 *
 * watch - the status charts that a project keeps: names of variables, a format and a comment
 * for each. It shows nothing and reads no value.
 *
 * They are lines of the file's VIEW part, so they are saved and undone with it:
 *
 *   status-chart Motors
 *     watch auto Start the green button
 *     watch hex %QW0
 *
 * The program need not have the name.
 */
#ifndef EDITOR_WATCH_H
#define EDITOR_WATCH_H

#include "editor-gtk/sim/live_value.h"

struct watch_line {
	enum live_format format;
	char *name, *comment;
};
struct watch {
	char *name;
	GPtrArray *lines;   /* of struct watch_line *                          */
};

/** watch_line_new - Owns: the caller, or the chart it is added to. */
struct watch_line *watch_line_new(enum live_format format, const char *name,
				  const char *comment);
void watch_line_free(struct watch_line *line);
struct watch *watch_new(const char *name);

/** watch_list_read - the charts of a VIEW part, of struct watch *, in its order. Caller:
 * g_ptr_array_unref(). */
GPtrArray *watch_list_read(const char *view);
/** watch_list_write - @view with its charts replaced by @charts; other lines stay. Caller
 * frees. */
char *watch_list_write(const char *view, GPtrArray *charts);

/** watch_list_of, watch_list_keep - the charts of a document; keeping them is the step @name of
 * its history. Fails: false: the document is text only. */
GPtrArray *watch_list_of(LadderDocument *document);
bool watch_list_keep(LadderDocument *document, GPtrArray *charts, const char *name);

#endif
