/* SPDX-License-Identifier: MIT
 *
 * pou_file - moves a program or block to another file; see pou_file.h.
 */
#include "editor-gtk/document/pou_file.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/document/pou_import.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/xref/xref.h"

#include <string.h>

struct moving {
	LadderDocument *document;
	int pou;
	const char *path;
	GString *told;
	LadderSideFile *file;    /* at @path; NULL: not opened yet              */
	bool fresh;              /* it did not exist                            */
};

static const char *name_of(const struct moving *moving)
{
	const struct project *project = ladder_document_project(moving->document);

	return project_text(project, project->pou[moving->pou].name);
}

static bool refuse(struct moving *moving, char *why)
{
	g_string_assign(moving->told, why);
	g_free(why);
	return false;
}

/* ---- names of files ---- */

char *pou_file_name(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);

	return g_strdup_printf("%s.rung", project_text(project, project->pou[pou].name));
}

char *pou_file_path(LadderDocument *document, const char *name)
{
	char *folder = g_path_get_dirname(ladder_document_path(document));
	char *file = g_str_has_suffix(name, ".rung") ? g_strdup(name) :
		     g_strconcat(name, ".rung", NULL);
	char *path = g_canonicalize_filename(file, folder);

	g_free(file);
	g_free(folder);
	return path;
}

char *pou_file_refusal(LadderDocument *document, const char *name)
{
	char *path = pou_file_path(document, name), *why = NULL;
	char *folder = g_path_get_dirname(path);
	LadderSideFile *open = side_file_find(document, path);

	if (!*name)
		why = g_strdup(_("A name is needed"));
	else if (strpbrk(name, "\n\"$"))
		why = g_strdup(_("The name cannot have \" or $"));
	else if (g_file_test(path, G_FILE_TEST_EXISTS) ||
		 (open && !ladder_side_file_is_nothing(open)))
		why = g_strdup(_("The file exists. “Existing file…” chooses it."));
	else if (!g_file_test(folder, G_FILE_TEST_IS_DIR))
		why = g_strdup(_("There is no such folder"));
	g_free(folder);
	g_free(path);
	return why;
}

/* @path as it is seen from the folder of the project: "parts/motor.rung", "../motor.rung".
 * Caller frees. */
static char *seen_from(const char *project, const char *path)
{
	char *folder = g_path_get_dirname(project);
	GString *up = g_string_new(NULL);
	char *out = NULL;

	while (!out) {
		GFile *from = g_file_new_for_path(folder), *to = g_file_new_for_path(path);
		char *rest = g_file_get_relative_path(from, to), *above;

		out = rest ? g_strconcat(up->str, rest, NULL) : NULL;
		g_string_append(up, "../");
		above = g_path_get_dirname(folder);
		g_free(folder);
		folder = above;
		g_free(rest);
		g_object_unref(to);
		g_object_unref(from);
	}
	g_string_free(up, TRUE);
	g_free(folder);
	return out;
}

/* ---- what the other file is ---- */

/* The file as a project of its own; NULL: it cannot be read alone. */
static struct ladder *alone(const struct moving *moving)
{
	struct ladder *ladder = ladder_document_reader(moving->document);
	char *text = ladder_side_file_text(moving->file);

	if (!ladder_load_text(ladder, g_intern_string(moving->path), text, strlen(text)) ||
	    !ladder_project(ladder)) {
		ladder_free(ladder);
		ladder = NULL;
	}
	g_free(text);
	return ladder;
}

/* The file with the INCLUDE that closes a circle, from the errors of @ladder; NULL: none. */
static const char *circle_in(struct ladder *ladder)
{
	const struct diag_list *diags = ladder_diags(ladder);

	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].id == DIAG_INCLUDE_CIRCLE)
			return diags->diag[i].file;
	return NULL;
}

static bool has_programs(const struct project *project)
{
	bool has = project->config != NULL;

	for (int i = 0; i < project->pou_count; i++)
		has = has || (project->pou[i].kind == POU_PROGRAM && !project->pou[i].included);
	return has;
}

/* Does the other file have programs that would run here too, and not be moved here by us? */
static bool is_foreign(const struct moving *moving)
{
	struct ladder *ladder;
	bool is;

	if (moving->fresh || ladder_document_includes(moving->document, moving->path))
		return false;
	ladder = alone(moving);
	is = ladder && has_programs(ladder_project(ladder));
	ladder_free(ladder);
	return is;
}

/* A library (USES) holds no programs. */
static bool is_library(const struct moving *moving)
{
	const struct project *project = ladder_document_project(moving->document);

	for (int i = 0; i < project->used_count; i++)
		if (disk_same(project->used[i], moving->path))
			return true;
	return false;
}

/* What uses it: another POU, else the file of the project, whose declarations do. NULL: nothing
 * does. Caller frees. */
static char *user_of(const struct moving *moving)
{
	struct project *project = ladder_document_project(moving->document);
	struct xref xref = { 0 };
	char *user = NULL;
	bool declared = false;

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count && !user; i++) {
		const struct xref_use *use = &xref.use[i];
		const bool is = use->target.what == XREF_POU &&
			use->target.index == moving->pou && use->kind != XREF_DECLARED &&
			use->pou != moving->pou;

		declared = declared || is;
		if (is && use->pou >= 0)
			user = g_strdup(project_text(project, project->pou[use->pou].name));
	}
	xref_free(&xref);
	return user || !declared ? user :
	       g_path_get_basename(ladder_document_path(moving->document));
}

/* ---- the step ---- */

static bool open_file(struct moving *moving)
{
	LadderSideFile *there = side_file_find(moving->document, moving->path);
	GError *error = NULL;

	if (there) {
		moving->file = g_object_ref(there);
		return true;
	}
	moving->fresh = !g_file_test(moving->path, G_FILE_TEST_EXISTS);
	moving->file = moving->fresh ? ladder_side_file_make(moving->path, moving->document) :
		       ladder_side_file_open(moving->path, moving->document, &error);
	if (!moving->file)
		refuse(moving, g_strdup(error->message));
	g_clear_error(&error);
	return moving->file;
}

/* The text of the other file, with @part at its end. Caller frees. */
static char *with_part(const struct moving *moving, const char *part)
{
	char *text = ladder_side_file_text(moving->file), *all;

	if (!*text) {
		g_free(text);
		text = g_strdup("RUNGBOARD 1\n");
	}
	all = g_strconcat(text, g_str_has_suffix(text, "\n") ? "\n" : "\n\n", part, NULL);
	g_free(text);
	return all;
}

/* The number of errors of the project when it is built; @first: gets the first one, or NULL. */
static int errors_of(LadderDocument *document, char **first)
{
	struct ladder *ladder = ladder_document_reader(document);
	const char *path = ladder_document_path(document);
	gsize len;
	char *text = ladder_document_text(document, &len);
	int errors;

	if (ladder_load_text(ladder, g_intern_string(path), text, len))
		ladder_build(ladder);
	errors = ladder_diags(ladder)->errors;
	*first = errors ? diag_said_whole(diag_first_error(ladder_diags(ladder))) : NULL;
	g_free(text);
	ladder_free(ladder);
	return errors;
}

/* "Main, Pump": the order in which programs run. Caller frees. */
static char *order_of(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);
	GString *out = g_string_new(NULL);

	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM)
			g_string_append_printf(out, "%s%s", out->len ? ", " : "",
				project_text(project, project->pou[i].name));
	return g_string_free(out, FALSE);
}

/* Why the text could not be read after the move, as an advice. Caller frees. */
static char *reason_of(struct moving *moving, char *why)
{
	struct ladder *ladder = ladder_document_reader(moving->document);
	char *text = ladder_side_file_text(moving->file), *advice = NULL;
	char *name = g_path_get_basename(moving->path);
	const char *closes;

	ladder_load_text(ladder, g_intern_string(moving->path), text, strlen(text));
	closes = circle_in(ladder);
	if (!closes && ladder_read_project(ladder)) {
		const struct project *project = ladder_read_project(ladder);

		for (int i = 0; i < project->pou_count && !closes; i++)
			if (project->pou[i].file && disk_same(project->pou[i].file,
				ladder_document_path(moving->document)))
				closes = moving->path;
	}
	if (closes) {
		char *own = g_path_get_basename(ladder_document_path(moving->document));

		advice = g_strdup_printf(_("“%s” includes “%s”, so “%s” cannot include it. Delete that "
			"INCLUDE there first, or choose another file."), name, own, own);
		g_free(own);
	}
	ladder_free(ladder);
	g_free(text);
	g_free(name);
	if (!advice)
		return why;
	g_free(why);
	return advice;
}

/* The change of both texts, in an open step. Returns NULL, or why it failed. */
static char *change(struct moving *moving, const char *all, gsize at, gsize len)
{
	const char *own = ladder_document_path(moving->document);
	char *part = g_strndup(all + at, len), *text = with_part(moving, part), *why;
	char *seen = seen_from(own, moving->path);
	char *line = ladder_document_includes(moving->document, moving->path) ? g_strdup("") :
		     g_strdup_printf("INCLUDE \"%s\"\n", seen);

	ladder_side_file_set(moving->file, text);
	why = ladder_document_replace_step(moving->document, at, len, line, _("Move to file"));
	g_free(line);
	g_free(seen);
	g_free(text);
	g_free(part);
	return why;
}

static void finish(struct moving *moving, const char *name, const char *before)
{
	char *file = g_path_get_basename(moving->path), *after = order_of(moving->document);

	g_string_printf(moving->told, _("“%s” is now in “%s”, which this project includes"), name,
			file);
	if (strcmp(before, after) != 0 && pou_order_counts(moving->document))
		g_string_append_printf(moving->told, _(". The programs now run in this order: %s"),
				       after);
	g_free(after);
	g_free(file);
}

static bool move_inside(struct moving *moving)
{
	char *name = g_strdup(name_of(moving)), *before = order_of(moving->document);
	char *all, *why, *was, *is = NULL;
	const int errors = errors_of(moving->document, &was);
	struct text_span part;
	bool good;

	all = pou_part(moving->document, moving->pou, &part);
	ladder_document_begin(moving->document, _("Move to file"), NULL);
	why = change(moving, all, part.at, part.len);
	if (why)
		why = reason_of(moving, why);
	else if (errors_of(moving->document, &is) > errors)
		why = g_strdup_printf(_("With “%s” in the other file, the project would have errors: "
			"%s"), name, is);
	good = !why;
	if (good) {
		ladder_document_end(moving->document);
		finish(moving, name, before);
	} else {
		ladder_document_cancel(moving->document);
		refuse(moving, why);
	}
	g_free(is);
	g_free(was);
	g_free(all);
	g_free(before);
	g_free(name);
	return good;
}

/* To a project of its own, with all that it needs. */
static bool move_outside(struct moving *moving)
{
	char *text = pou_export_text(moving->document, moving->pou, moving->file, moving->told);
	const char *why = NULL;

	if (!text)
		return false;
	ladder_document_begin(moving->document, _("Move to file"), NULL);
	ladder_side_file_set(moving->file, text);
	why = pou_delete(moving->document, moving->pou);
	if (why)
		ladder_document_cancel(moving->document);
	else
		ladder_document_end(moving->document);
	if (why)
		g_string_assign(moving->told, why);
	g_free(text);
	return !why;
}

/* To a file with programs of its own, which this project does not include. */
static bool move_away(struct moving *moving)
{
	char *user = user_of(moving), *file = g_path_get_basename(moving->path);
	const bool good = user ? refuse(moving, g_strdup_printf(
		_("“%s” uses “%s”, so this project must include “%s”. But that file has programs of "
		  "its own, which would run here, too. Choose a new file, or one without programs."),
		user, name_of(moving), file)) : move_outside(moving);

	g_free(file);
	g_free(user);
	return good;
}

static bool move(struct moving *moving)
{
	const struct project *project = ladder_document_project(moving->document);
	char *file = g_path_get_basename(moving->path);
	bool good;

	if (is_foreign(moving))
		good = move_away(moving);
	else if (project->pou[moving->pou].kind == POU_PROGRAM && is_library(moving))
		good = refuse(moving, g_strdup_printf(_("“%s” is a library (USES), which has no "
			"programs. Choose another file."), file));
	else
		good = move_inside(moving);
	g_free(file);
	return good;
}

bool pou_to_file(LadderDocument *document, int pou, const char *path, GString *told)
{
	struct moving moving = { .document = document, .pou = pou, .path = path, .told = told };
	const struct project *project = ladder_document_project(document);
	const char *own = ladder_document_path(document);
	bool good;

	g_string_truncate(told, 0);
	if (!project || !ladder_document_is_whole(document))
		return refuse(&moving, g_strdup(_("Nothing can be copied or moved until the whole project can be read. Correct its errors first")));
	if (!own)
		return refuse(&moving, g_strdup(_("Save the project first. The other file is found "
			"beside it.")));
	if (project->pou[pou].included)
		return refuse(&moving, g_strdup(_("It is declared in another file")));
	if (disk_same(own, path))
		return refuse(&moving, g_strdup(_("This is the file of this project. Choose "
			"another.")));
	if (!open_file(&moving))
		return false;
	good = move(&moving);
	if (good)
		g_signal_emit_by_name(document, "file-opened", moving.file);
	g_object_unref(moving.file);
	return good;
}
