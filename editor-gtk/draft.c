/* SPDX-License-Identifier: MIT
 *
 * draft - what was not saved, kept where a crash does not reach it.
 *
 * A draft is a file "PID-NUMBER.draft": a line with the path as a URI and the sum of what
 * stood there, if they are known, and the text. A file whose process is alive belongs to that.
 */
#include "editor-gtk/draft.h"

#include <glib/gstdio.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DRAFT_SECONDS 2 /* after the last change                               */
#define DRAFT_HEAD    "RUNGBOARD-DRAFT 1 "

struct keeper {
	char *file;
	guint timer;
};

static char *folder(void)
{
	return g_build_filename(g_get_user_state_dir(), "rungboard", "drafts", NULL);
}

static struct keeper *keeper_of(LadderDocument *document)
{
	return g_object_get_data(G_OBJECT(document), "draft");
}

/* ---- keeping ---- */

void draft_write(LadderDocument *document)
{
	struct keeper *keeper = keeper_of(document);
	const char *path = ladder_document_path(document);
	gsize len;
	const char *sum = ladder_document_disk_sum(document);
	char *text, *whole, *dir, *uri;

	if (!keeper || ladder_document_is_saved(document))
		return;
	text = ladder_document_text(document, &len);
	uri = path ? g_filename_to_uri(path, NULL, NULL) : NULL;
	whole = g_strdup_printf(DRAFT_HEAD "%s %s\n%s", uri ? uri : "", sum ? sum : "", text);
	g_free(uri);
	dir = g_path_get_dirname(keeper->file);
	g_mkdir_with_parents(dir, 0700);
	g_file_set_contents_full(keeper->file, whole, (gssize)strlen(whole),
		G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE, 0600, NULL);
	g_free(dir);
	g_free(whole);
	g_free(text);
}

static gboolean write_now(gpointer document)
{
	keeper_of(document)->timer = 0;
	draft_write(document);
	return G_SOURCE_REMOVE;
}

static void state_changed(LadderDocument *document, struct keeper *keeper)
{
	if (ladder_document_is_saved(document)) {
		g_unlink(keeper->file);
		return;
	}
	if (!keeper->timer)
		keeper->timer = g_timeout_add_seconds(DRAFT_SECONDS, write_now, document);
}

static void keeper_free(gpointer pointer)
{
	struct keeper *keeper = pointer;

	if (keeper->timer)
		g_source_remove(keeper->timer);
	g_free(keeper->file);
	g_free(keeper);
}

void draft_keep(LadderDocument *document)
{
	static int number;
	struct keeper *keeper = g_new0(struct keeper, 1);
	char *dir = folder();
	char *name = g_strdup_printf("%ld-%d.draft", (long)getpid(), ++number);

	keeper->file = g_build_filename(dir, name, NULL);
	g_object_set_data_full(G_OBJECT(document), "draft", keeper, keeper_free);
	g_signal_connect(document, "state-changed", G_CALLBACK(state_changed), keeper);
	if (!ladder_document_is_saved(document))
		draft_write(document);
	g_free(name);
	g_free(dir);
}

void draft_remove(LadderDocument *document)
{
	struct keeper *keeper = keeper_of(document);

	if (!keeper)
		return;
	if (keeper->timer)
		g_source_remove(keeper->timer);
	keeper->timer = 0;
	g_unlink(keeper->file);
}

/* ---- finding ---- */

static void draft_free(gpointer pointer)
{
	struct draft *draft = pointer;

	g_free(draft->file);
	g_free(draft->path);
	g_free(draft->sum);
	g_free(draft->text);
	g_free(draft);
}

/* Numbers of processes come again: only an editor counts as the draft's owner. Where
 * /proc does not tell names, any process does. */
static bool is_alive(const char *name)
{
	const long pid = strtol(name, NULL, 10);
	char *path = g_strdup_printf("/proc/%ld/comm", pid), *comm = NULL, *own = NULL;
	bool alive = pid > 0 && (kill((pid_t)pid, 0) == 0 || errno == EPERM);

	if (alive && g_file_get_contents("/proc/self/comm", &own, NULL, NULL) &&
	    g_file_get_contents(path, &comm, NULL, NULL))
		alive = strcmp(own, comm) == 0;
	g_free(own);
	g_free(comm);
	g_free(path);
	return alive;
}

/* "URI SUM", and either may lack; a URI has no blanks. */
static void read_head(struct draft *draft, const char *head)
{
	char **words = g_strsplit(head, " ", 2);

	if (words[0] && *words[0])
		draft->path = g_filename_from_uri(words[0], NULL, NULL);
	if (words[0] && words[1] && *words[1])
		draft->sum = g_strdup(words[1]);
	g_strfreev(words);
}

static struct draft *read_draft(const char *file)
{
	struct draft *draft = g_new0(struct draft, 1);
	char *all = NULL, *line;
	gsize len;

	if (!g_file_get_contents(file, &all, &len, NULL) ||
	    !g_str_has_prefix(all, DRAFT_HEAD) || !(line = strchr(all, '\n'))) {
		g_free(all);
		g_free(draft);
		return NULL;
	}
	*line = '\0';
	draft->file = g_strdup(file);
	read_head(draft, all + strlen(DRAFT_HEAD));
	draft->text = g_strdup(line + 1);
	draft->len = strlen(draft->text);
	g_free(all);
	return draft;
}

GPtrArray *draft_find(void)
{
	GPtrArray *found = g_ptr_array_new_with_free_func(draft_free);
	char *dir = folder();
	GDir *names = g_dir_open(dir, 0, NULL);
	const char *name;

	while (names && (name = g_dir_read_name(names))) {
		char *file = g_build_filename(dir, name, NULL);
		struct draft *draft = g_str_has_suffix(name, ".draft") && !is_alive(name) ?
			read_draft(file) : NULL;

		if (draft)
			g_ptr_array_add(found, draft);
		else if (strstr(name, ".draft.") && !is_alive(name))
			g_unlink(file); /* it died while it wrote that one */
		g_free(file);
	}
	if (names)
		g_dir_close(names);
	g_free(dir);
	return found;
}

void draft_forget(const struct draft *draft)
{
	g_unlink(draft->file);
}
