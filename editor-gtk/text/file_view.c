/* SPDX-License-Identifier: MIT
 *
 * file_view - a text file beside the project: a scenario, an I/O map.
 */
#include "editor-gtk/text/file_view.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/file_history.h"
#include "editor-gtk/text/file_marks.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/iomap/iomap_view.h"
#include "editor-gtk/kit/text_scheme.h"

#include <gio/gio.h>
#include <gtksourceview/gtksource.h>
#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a file that is shown                    */

struct _LadderFileView {
	GtkBox parent;
	char *path;
	char *read;         /* what stood in it when it was read or saved      */
	GtkTextBuffer *buffer;
	GtkWidget *text;
	struct file_marks *marks;
	GtkWidget *map;     /* the table of an I/O map; NULL: it is none       */
	bool gone;          /* the file was, when it was looked for            */
	bool told_locked;   /* it is read-only: saved again, it is written over */
	struct file_history *history;
};

G_DEFINE_FINAL_TYPE(LadderFileView, ladder_file_view, GTK_TYPE_BOX)

static guint state_changed, was_undone, turned; /* signals */

static void tell_state(LadderFileView *view)
{
	g_signal_emit(view, state_changed, 0);
}

void ladder_file_view_commit(gpointer file)
{
	LadderFileView *view = file;

	if (view->map)
		ladder_iomap_view_commit(LADDER_IOMAP_VIEW(view->map));
}

/* Of a file that is gone this is the last copy. */
bool ladder_file_view_differs(LadderFileView *view)
{
	return gtk_text_buffer_get_modified(view->buffer) ||
	       !g_file_test(view->path, G_FILE_TEST_EXISTS);
}

bool ladder_file_view_is_saved(LadderFileView *view)
{
	ladder_file_view_commit(view);
	return !ladder_file_view_differs(view);
}

void ladder_file_view_look(gpointer file)
{
	LadderFileView *view = file;
	const bool gone = !g_file_test(view->path, G_FILE_TEST_EXISTS);

	if (gone == view->gone)
		return;
	view->gone = gone;
	tell_state(view);
}

GtkTextBuffer *ladder_file_view_buffer(LadderFileView *view)
{
	return view->buffer;
}

bool ladder_file_view_is_text(LadderFileView *view)
{
	return !view->map || ladder_iomap_view_is_text(LADDER_IOMAP_VIEW(view->map));
}

char *ladder_file_view_sum(LadderFileView *view)
{
	return g_compute_checksum_for_string(G_CHECKSUM_SHA256, view->read, -1);
}

/* What somebody else wrote meanwhile is not written over before that is told. A file that
 * is gone does not count. */
static bool is_as_read(LadderFileView *view, GError **error)
{
	gsize len;
	char *now = disk_read(view->path, FILE_MOST, &len, NULL);

	if (!now || strcmp(now, view->read) == 0) {
		g_free(now);
		return true;
	}
	g_free(view->read);
	view->read = now;
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_FAILED,
		    _("%s: somebody else changed it since it was opened; saved again, "
		      "it is written over"), view->path);
	return false;
}

/* So is what is read-only. */
static bool is_free(LadderFileView *view, GError **error)
{
	if (view->told_locked || !disk_is_locked(view->path))
		return true;
	view->told_locked = true;
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_ACCES,
		    _("%s: the file is read-only; saved again, it is written over"),
		    view->path);
	return false;
}

bool ladder_file_view_save(LadderFileView *view, GError **error)
{
	char *text;
	bool good;

	if (ladder_file_view_is_saved(view))
		return true;
	text = ladder_file_view_text(view);
	good = is_as_read(view, error) && is_free(view, error) &&
	       disk_save(view->path, text, strlen(text), error);
	if (good) {
		view->gone = false;
		g_free(view->read);
		view->read = g_steal_pointer(&text);
		file_history_saved(view->history);
		gtk_text_buffer_set_modified(view->buffer, FALSE);
		tell_state(view); /* it may have been gone, and nothing else      */
	}
	g_free(text);
	return good;
}

char *ladder_file_view_text(LadderFileView *view)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(view->buffer, &start, &end);
	return gtk_text_buffer_get_text(view->buffer, &start, &end, TRUE);
}

void ladder_file_view_append(LadderFileView *view, const char *text)
{
	GtkTextIter end;

	gtk_text_buffer_begin_user_action(view->buffer);
	gtk_text_buffer_get_end_iter(view->buffer, &end);
	gtk_text_buffer_insert(view->buffer, &end, text, -1);
	gtk_text_buffer_end_user_action(view->buffer);
}

struct file_marks *ladder_file_view_marks(LadderFileView *view)
{
	return view->marks;
}

void ladder_file_view_go(LadderFileView *view, int line)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(view->buffer, &at, MAX(line - 1, 0));
	gtk_text_buffer_place_cursor(view->buffer, &at);
	gtk_text_view_scroll_to_mark(GTK_TEXT_VIEW(view->text),
				     gtk_text_buffer_get_insert(view->buffer), 0.1, FALSE, 0,
				     0);
	gtk_widget_grab_focus(view->text);
}

const char *ladder_file_view_path(LadderFileView *view)
{
	return view->path;
}

char *ladder_file_view_name(LadderFileView *view)
{
	return g_path_get_basename(view->path);
}

/* A step of its history: the text is what was saved, or it is not. */
static void undone(gpointer data, const char *text)
{
	LadderFileView *view = data;

	gtk_text_buffer_set_modified(view->buffer, strcmp(text, view->read) != 0);
	g_signal_emit(view, was_undone, 0);
}

/* ---- life ---- */

static void ladder_file_view_dispose(GObject *object)
{
	g_clear_pointer(&LADDER_FILE_VIEW(object)->marks, file_marks_free);
	g_clear_pointer(&LADDER_FILE_VIEW(object)->history, file_history_free);
	g_clear_object(&LADDER_FILE_VIEW(object)->buffer);
	G_OBJECT_CLASS(ladder_file_view_parent_class)->dispose(object);
}

static void ladder_file_view_finalize(GObject *object)
{
	g_free(LADDER_FILE_VIEW(object)->path);
	g_free(LADDER_FILE_VIEW(object)->read);
	G_OBJECT_CLASS(ladder_file_view_parent_class)->finalize(object);
}

static void ladder_file_view_class_init(LadderFileViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_file_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_file_view_finalize;
	state_changed = g_signal_new("state-changed", LADDER_TYPE_FILE_VIEW,
		G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	was_undone = g_signal_new("undone", LADDER_TYPE_FILE_VIEW, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	turned = g_signal_new("turned", LADDER_TYPE_FILE_VIEW, G_SIGNAL_RUN_LAST, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_file_view_init(LadderFileView *view)
{
	gtk_orientable_set_orientation(GTK_ORIENTABLE(view), GTK_ORIENTATION_VERTICAL);
}

/* NULL, and why: too long, unreadable, no text. */
static char *text_of(const char *path, GError **error)
{
	gsize len;
	char *text = disk_read(path, FILE_MOST, &len, error);

	if (!text || g_utf8_validate_len(text, len, NULL))
		return text;
	g_free(text);
	g_set_error(error, G_IO_ERROR, G_IO_ERROR_INVALID_DATA, _("%s is no text file"),
		    path);
	return NULL;
}

static GtkWidget *text_widget(LadderFileView *view, const char *name)
{
	GtkSourceBuffer *buffer = gtk_source_buffer_new(NULL);
	GtkWidget *text = gtk_source_view_new_with_buffer(buffer);

	view->buffer = GTK_TEXT_BUFFER(buffer);
	view->text = text;
	text_scheme_follow(buffer);
	g_signal_connect_object(buffer, "modified-changed", G_CALLBACK(tell_state), view,
				G_CONNECT_SWAPPED);
	gtk_text_view_set_monospace(GTK_TEXT_VIEW(text), TRUE);
	gtk_source_view_set_show_line_numbers(GTK_SOURCE_VIEW(text), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(text), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
	return text;
}

static GtkWidget *told_label(void)
{
	GtkWidget *told = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(told), 0);
	gtk_label_set_wrap(GTK_LABEL(told), TRUE);
	gtk_widget_set_margin_start(told, 14);
	gtk_widget_add_css_class(told, "error");
	return told;
}

static void set_text(GtkTextBuffer *buffer, const char *text)
{
	gtk_text_buffer_begin_irreversible_action(buffer);
	gtk_text_buffer_set_text(buffer, text, -1);
	gtk_text_buffer_end_irreversible_action(buffer);
	gtk_text_buffer_set_modified(buffer, FALSE);
}

static void tell_turned(LadderFileView *view)
{
	g_signal_emit(view, turned, 0);
}

static GtkWidget *map_of(LadderFileView *view, GtkWidget *text, LadderDocument *document)
{
	GtkWidget *map = ladder_iomap_view_new(view->buffer, text, document);

	g_signal_connect_object(map, "turned", G_CALLBACK(tell_turned), view,
				G_CONNECT_SWAPPED);
	return map;
}

/* @text: what stands in the file; taken over. */
static LadderFileView *view_of(const char *path, char *text, LadderDocument *document)
{
	LadderFileView *view = g_object_new(LADDER_TYPE_FILE_VIEW, NULL);
	char *name = g_path_get_basename(path);
	GtkWidget *scroller = gtk_scrolled_window_new(), *told = told_label();

	view->path = g_strdup(path);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller),
				      text_widget(view, name));
	set_text(view->buffer, text);
	if (g_str_has_suffix(name, ".io"))
		view->map = map_of(view, scroller, document);
	gtk_box_append(GTK_BOX(view), view->map ? view->map : scroller);
	gtk_box_append(GTK_BOX(view), told);
	view->marks = file_marks_new(view->buffer, GTK_LABEL(told));
	view->read = text;
	view->history = file_history_new(view->buffer, document, name, undone, view);
	g_free(name);
	return view;
}

GtkWidget *ladder_file_view_new(const char *path, LadderDocument *document, GError **error)
{
	char *text = text_of(path, error);

	return text ? GTK_WIDGET(view_of(path, text, document)) : NULL;
}

void ladder_file_view_put(LadderFileView *view, const char *text, const char *sum)
{
	char *now = ladder_file_view_sum(view);

	gtk_text_buffer_begin_user_action(view->buffer);
	gtk_text_buffer_set_text(view->buffer, text, -1);
	gtk_text_buffer_end_user_action(view->buffer);
	gtk_text_buffer_set_modified(view->buffer, TRUE);
	if (g_strcmp0(now, sum) != 0) {
		g_free(view->read);
		view->read = g_strdup("");
	}
	g_free(now);
}

GtkWidget *ladder_file_view_restore(const char *path, const char *sum, const char *text,
				    LadderDocument *document)
{
	char *there = text_of(path, NULL);
	LadderFileView *view = view_of(path, there ? there : g_strdup(""), document);

	ladder_file_view_put(view, text, sum);
	return GTK_WIDGET(view);
}

/* ---- which there are ---- */

/* Is @name `STEM.io`, `STEM-2.io` …: how long the stem is; 0: it is not. */
static gsize stem_of(const char *name, const char *stem)
{
	const gsize len = strlen(stem);

	return g_str_has_prefix(name, stem) && !g_ascii_isalnum(name[len]) &&
	       !(name[len] & 0x80) ? len : 0;
}

/* It is of the program with the longest name that it begins with. */
static bool is_own(const char *name, const char *stem, const GPtrArray *programs)
{
	const gsize len = stem_of(name, stem);

	for (guint i = 0; len > 0 && i < programs->len; i++)
		if (stem_of(name, programs->pdata[i]) > len)
			return false;
	return len > 0;
}

/* Names without their ending of all rung files in a folder. */
static GPtrArray *programs_in(const char *folder)
{
	GPtrArray *programs = g_ptr_array_new_with_free_func(g_free);
	GDir *dir = g_dir_open(folder, 0, NULL);
	const char *name;

	while (dir && (name = g_dir_read_name(dir)))
		if (g_str_has_suffix(name, ".rung"))
			g_ptr_array_add(programs, g_strndup(name,
				strlen(name) - strlen(".rung")));
	if (dir)
		g_dir_close(dir);
	return programs;
}

struct beside {
	const char *stem, *ending;
	bool own;
	GPtrArray *programs, *files;
};

static void add_files(struct beside *beside, const char *folder)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	const char *name;

	while (dir && (name = g_dir_read_name(dir)))
		if (g_str_has_suffix(name, beside->ending) &&
		    is_own(name, beside->stem, beside->programs) == beside->own)
			g_ptr_array_add(beside->files, g_build_filename(folder, name,
									NULL));
	if (dir)
		g_dir_close(dir);
}

static int by_name(gconstpointer a, gconstpointer b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

GPtrArray *files_beside(const char *path, const char *ending, bool own)
{
	GPtrArray *files = g_ptr_array_new_with_free_func(g_free);
	char *folder, *boards, *stem;
	struct beside beside = { NULL, ending, own, NULL, files };

	if (!path)
		return files;
	folder = g_path_get_dirname(path);
	boards = g_build_filename(folder, "boards", NULL);
	stem = g_path_get_basename(path);
	if (strrchr(stem, '.'))
		*strrchr(stem, '.') = '\0';
	beside.stem = stem;
	beside.programs = programs_in(folder);
	add_files(&beside, folder);
	add_files(&beside, boards);
	g_ptr_array_sort(files, by_name);
	g_ptr_array_unref(beside.programs);
	g_free(folder);
	g_free(boards);
	g_free(stem);
	return files;
}

/* ---- whose one is ---- */

bool file_is_beside(const char *path)
{
	return g_str_has_suffix(path, ".scn") || g_str_has_suffix(path, ".io");
}

/* Borrowed; NULL: there are none, or several. */
static const char *only_one(const GPtrArray *programs)
{
	const char *only = NULL;

	for (guint i = 0; i < programs->len; i++) {
		if (g_str_has_suffix(programs->pdata[i], ".plant"))
			continue;
		if (only)
			return NULL;
		only = programs->pdata[i];
	}
	return only;
}

static char *project_in(const char *folder, const char *name)
{
	GPtrArray *programs = programs_in(folder);
	const char *best = NULL;
	char *file, *path;

	for (guint i = 0; i < programs->len; i++)
		if (stem_of(name, programs->pdata[i]) > (best ? strlen(best) : 0))
			best = programs->pdata[i];
	if (!best)
		best = only_one(programs);
	file = best ? g_strconcat(best, ".rung", NULL) : NULL;
	path = file ? g_build_filename(folder, file, NULL) : NULL;
	g_free(file);
	g_ptr_array_unref(programs);
	return path;
}

char *file_project(const char *path)
{
	char *folder = g_path_get_dirname(path), *name = g_path_get_basename(path);
	char *last = g_path_get_basename(folder), *above = g_path_get_dirname(folder);
	char *project = project_in(folder, name);

	if (!project && strcmp(last, "boards") == 0)
		project = project_in(above, name);
	g_free(above);
	g_free(last);
	g_free(name);
	g_free(folder);
	return project;
}
