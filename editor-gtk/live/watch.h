/* SPDX-License-Identifier: MIT
 *
 * watch - the status charts that a project keeps: names of variables, how each is
 * shown, what a person says of it.
 *
 * They are lines of the file's VIEW part, so that they are saved with it and undone like
 * everything else:
 *
 *   status-chart Motors
 *     watch auto Start the green button
 *     watch hex %QW0
 *
 * A name need not be one of the program. It shows nothing and reads no value.
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

/** watch_list_read - those of a VIEW part, of struct watch *, in its order. Caller:
 * g_ptr_array_unref(). */
GPtrArray *watch_list_read(const char *view);
/** watch_list_write - @view with these charts in the place of those that it had; its
 * other lines stay. Caller frees. */
char *watch_list_write(const char *view, GPtrArray *charts);

/** watch_list_of, watch_list_keep - those of a document; what is kept is one step of
 * its history, @name behind Undo. Fails: false: a document of text has none. */
GPtrArray *watch_list_of(LadderDocument *document);
bool watch_list_keep(LadderDocument *document, GPtrArray *charts, const char *name);

#endif
