/* SPDX-License-Identifier: MIT
 *
 * side_file - a text file beside the project while a person works on it.
 */
#include "editor-gtk/document/side_file.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/file_history.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/text_scheme.h"

#include <glib/gstdio.h>
#include <gtksourceview/gtksource.h>
#include <errno.h>
#include <string.h>

#define FILE_MOST (4 << 20) /* bytes                                           */

struct _LadderSideFile {
	GObject parent;
	char *path;
	char *read;         /* the text of the file when it was read or saved  */
	GtkTextBuffer *buffer;
	LadderDocument *document;
	struct file_history *history;
	bool gone;          /* the file was, at the last look                  */
	bool made;          /* here: with an empty text it is deleted          */
	bool told_locked;   /* the next save overwrites a read-only file       */
};

G_DEFINE_FINAL_TYPE(LadderSideFile, ladder_side_file, G_TYPE_OBJECT)

static guint state_changed, undone, commit; /* signals */

static void tell_state(LadderSideFile *file)
{
	g_signal_emit(file, state_changed, 0);
}

void ladder_side_file_commit(gpointer file)
{
	g_signal_emit(file, commit, 0);
}

bool ladder_side_file_is_nothing(LadderSideFile *file)
{
	return gtk_text_buffer_get_char_count(file->buffer) == 0 &&
	       !g_file_test(file->path, G_FILE_TEST_EXISTS);
}

bool ladder_side_file_is_part(LadderSideFile *file)
{
	return !side_file_is(file->path);
}

/* The text of a file that is gone is the last copy. */
bool ladder_side_file_differs(LadderSideFile *file)
{
	return !ladder_side_file_is_nothing(file) &&
	       (gtk_text_buffer_get_modified(file->buffer) ||
		!g_file_test(file->path, G_FILE_TEST_EXISTS));
}

bool ladder_side_file_is_saved(LadderSideFile *file)
{
	ladder_side_file_commit(file);
	return !ladder_side_file_differs(file);
}

void ladder_side_file_look(gpointer data)
{
	LadderSideFile *file = data;
	const bool gone = !g_file_test(file->path, G_FILE_TEST_EXISTS);

	if (gone == file->gone)
		return;
	file->gone = gone;
	tell_state(file);
}

const char *ladder_side_file_path(LadderSideFile *file)
{
	return file->path;
}

LadderDocument *ladder_side_file_document(LadderSideFile *file)
{
	return file->document;
}

GtkTextBuffer *ladder_side_file_buffer(LadderSideFile *file)
{
	return file->buffer;
}

char *ladder_side_file_name(LadderSideFile *file)
{
	return g_path_get_basename(file->path);
}

char *ladder_side_file_text(LadderSideFile *file)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(file->buffer, &start, &end);
	return gtk_text_buffer_get_text(file->buffer, &start, &end, TRUE);
}

char *ladder_side_file_sum(LadderSideFile *file)
{
	return g_compute_checksum_for_string(G_CHECKSUM_SHA256, file->read, -1);
}

void ladder_side_file_set(LadderSideFile *file, const char *text)
{
	gtk_text_buffer_begin_user_action(file->buffer);
	gtk_text_buffer_set_text(file->buffer, text, -1);
	gtk_text_buffer_end_user_action(file->buffer);
}

void ladder_side_file_append(LadderSideFile *file, const char *text)
{
	GtkTextIter end;

	gtk_text_buffer_begin_user_action(file->buffer);
	gtk_text_buffer_get_end_iter(file->buffer, &end);
	gtk_text_buffer_insert(file->buffer, &end, text, -1);
	gtk_text_buffer_end_user_action(file->buffer);
}

/* ---- saving ---- */

/* A file that is gone counts as unchanged. */
static bool is_as_read(LadderSideFile *file, GError **error)
{
	gsize len;
	char *now = disk_read(file->path, FILE_MOST, &len, NULL);

	if (!now || strcmp(now, file->read) == 0) {
		g_free(now);
		return true;
	}
	g_free(file->read);
	file->read = now;
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_FAILED,
		    _("“%s” was changed by another program since it was opened. Save "
		      "again to overwrite it."), file->path);
	return false;
}

static bool is_free(LadderSideFile *file, GError **error)
{
	if (file->told_locked || !disk_is_locked(file->path))
		return true;
	file->told_locked = true;
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_ACCES,
		    _("“%s” is read-only. Save again to overwrite it."),
		    file->path);
	return false;
}

static bool write_text(LadderSideFile *file, const char *text, GError **error)
{
	if (!file->made || *text)
		return disk_save(file->path, text, strlen(text), error);
	if (g_unlink(file->path) == 0)
		return true;
	g_set_error(error, G_FILE_ERROR, g_file_error_from_errno(errno), _("%s: %s"), file->path,
		    g_strerror(errno));
	return false;
}

bool ladder_side_file_save(LadderSideFile *file, GError **error)
{
	char *text;
	bool good;

	if (ladder_side_file_is_saved(file))
		return true;
	text = ladder_side_file_text(file);
	good = is_as_read(file, error) && is_free(file, error) &&
	       write_text(file, text, error);
	if (good) {
		file->gone = false;
		g_free(file->read);
		file->read = g_steal_pointer(&text);
		file_history_saved(file->history);
		gtk_text_buffer_set_modified(file->buffer, FALSE);
		tell_state(file); /* the file may have been gone, the text unmodified */
	}
	g_free(text);
	return good;
}

/* ---- life ---- */

/* The open files of a document, borrowed. */
static GPtrArray *open_files(LadderDocument *document)
{
	GPtrArray *files = g_object_get_data(G_OBJECT(document), "side-files");

	if (!files) {
		files = g_ptr_array_new();
		g_object_set_data_full(G_OBJECT(document), "side-files", files,
				       (GDestroyNotify)g_ptr_array_unref);
	}
	return files;
}

LadderSideFile *side_file_find(LadderDocument *document, const char *path)
{
	GPtrArray *files = open_files(document);

	for (guint i = 0; i < files->len; i++)
		if (disk_same(path, ladder_side_file_path(files->pdata[i])))
			return files->pdata[i];
	return NULL;
}

static void ladder_side_file_dispose(GObject *object)
{
	LadderSideFile *file = LADDER_SIDE_FILE(object);

	if (file->document)
		g_ptr_array_remove(open_files(file->document), file);
	g_clear_pointer(&file->history, file_history_free);
	g_clear_object(&file->document);
	G_OBJECT_CLASS(ladder_side_file_parent_class)->dispose(object);
}

static void ladder_side_file_finalize(GObject *object)
{
	LadderSideFile *file = LADDER_SIDE_FILE(object);

	g_object_unref(file->buffer);
	g_free(file->path);
	g_free(file->read);
	G_OBJECT_CLASS(ladder_side_file_parent_class)->finalize(object);
}

static guint new_signal(const char *name)
{
	return g_signal_new(name, LADDER_TYPE_SIDE_FILE, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
			    NULL, G_TYPE_NONE, 0);
}

static void ladder_side_file_class_init(LadderSideFileClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_side_file_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_side_file_finalize;
	state_changed = new_signal("state-changed");
	undone = new_signal("undone");
	commit = new_signal("commit");
}

static void ladder_side_file_init(LadderSideFile *file)
{
	GtkSourceBuffer *buffer = gtk_source_buffer_new(NULL);

	file->buffer = GTK_TEXT_BUFFER(buffer);
	text_scheme_follow(buffer);
	g_signal_connect_object(buffer, "modified-changed", G_CALLBACK(tell_state), file,
				G_CONNECT_SWAPPED);
}

/* A step of its history: the text is what was saved, or it is not. */
static void step_undone(gpointer data, const char *text)
{
	LadderSideFile *file = data;

	gtk_text_buffer_set_modified(file->buffer, strcmp(text, file->read) != 0);
	g_signal_emit(file, undone, 0);
}

/* NULL: it is too long, unreadable, or no text; @error says which. */
static char *text_of(const char *path, GError **error)
{
	gsize len;
	char *text = disk_read(path, FILE_MOST, &len, error);

	if (!text || g_utf8_validate_len(text, len, NULL))
		return text;
	g_free(text);
	g_set_error(error, G_IO_ERROR, G_IO_ERROR_INVALID_DATA, _("“%s” is not a text file"),
		    path);
	return NULL;
}

static void set_text(GtkTextBuffer *buffer, const char *text)
{
	gtk_text_buffer_begin_irreversible_action(buffer);
	gtk_text_buffer_set_text(buffer, text, -1);
	gtk_text_buffer_end_irreversible_action(buffer);
	gtk_text_buffer_set_modified(buffer, FALSE);
}

/* @text: of the file; taken over. */
static LadderSideFile *file_of(const char *path, char *text, LadderDocument *document)
{
	LadderSideFile *file = g_object_new(LADDER_TYPE_SIDE_FILE, NULL);

	file->path = g_strdup(path);
	file->read = text;
	file->document = g_object_ref(document);
	g_ptr_array_add(open_files(document), file);
	set_text(file->buffer, text);
	file->history = file_history_new(file->buffer, document, path, !side_file_is(path),
					 step_undone, file);
	return file;
}

LadderSideFile *ladder_side_file_open(const char *path, LadderDocument *document,
				      GError **error)
{
	char *text = text_of(path, error);

	return text ? file_of(path, text, document) : NULL;
}

LadderSideFile *ladder_side_file_make(const char *path, LadderDocument *document)
{
	LadderSideFile *file = file_of(path, g_strdup(""), document);

	file->made = true;
	return file;
}

void ladder_side_file_put(LadderSideFile *file, const char *text, const char *sum)
{
	char *now = ladder_side_file_sum(file);

	ladder_side_file_set(file, text);
	gtk_text_buffer_set_modified(file->buffer, TRUE);
	if (g_strcmp0(now, sum) != 0) {
		g_free(file->read);
		file->read = g_strdup("");
	}
	g_free(now);
}

LadderSideFile *ladder_side_file_restore(const char *path, const char *sum, const char *text,
					 LadderDocument *document)
{
	char *there = text_of(path, NULL);
	LadderSideFile *file = file_of(path, there ? there : g_strdup(""), document);

	ladder_side_file_put(file, text, sum);
	return file;
}

/* ---- which files belong to a project ---- */

/* Is @name `STEM.io`, `STEM-2.io` …: how long the stem is; 0: it is not. */
static gsize stem_of(const char *name, const char *stem)
{
	const gsize len = strlen(stem);

	return g_str_has_prefix(name, stem) && !g_ascii_isalnum(name[len]) &&
	       !(name[len] & 0x80) ? len : 0;
}

/* A file belongs to the program with the longest name that the file's name begins with. */
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

GPtrArray *side_file_list(const char *path, const char *ending, bool own)
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

bool side_file_is(const char *path)
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

/* The folder or file of plain IEC text with the name of @path, if no rung file has it. */
static char *plain_of(const char *path)
{
	static const char *const endings[] = { ".rung", "", ".st", ".iec", ".il" };
	char *stem = g_strndup(path, strlen(path) - strlen(strrchr(path, '.')));
	char *found = NULL;

	for (guint i = 0; i < G_N_ELEMENTS(endings) && !found; i++) {
		found = g_strconcat(stem, endings[i], NULL);
		if (!g_file_test(found, *endings[i] ? G_FILE_TEST_IS_REGULAR : G_FILE_TEST_IS_DIR))
			g_clear_pointer(&found, g_free);
	}
	if (found && g_str_has_suffix(found, ".rung"))
		g_clear_pointer(&found, g_free);
	g_free(stem);
	return found;
}

char *side_file_project(const char *path)
{
	char *folder = g_path_get_dirname(path), *name = g_path_get_basename(path);
	char *last = g_path_get_basename(folder), *above = g_path_get_dirname(folder);
	char *project = plain_of(path);

	if (!project)
		project = project_in(folder, name);

	if (!project && strcmp(last, "boards") == 0)
		project = project_in(above, name);
	g_free(above);
	g_free(last);
	g_free(name);
	g_free(folder);
	return project;
}
