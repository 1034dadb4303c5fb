/* SPDX-License-Identifier: MIT
 *
 * pou_import - imports programs and blocks of another project, with their declarations.
 */
#include "editor-gtk/document/pou_import.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* The POUs, globals and types to import, by their numbers in the other project. */
struct wanted {
	bool *pou, *global, *structure;
	int pous, globals, structures;
};

/* ---- dependencies ---- */

static bool want(bool *all, int index)
{
	const bool fresh = !all[index];

	all[index] = true;
	return fresh;
}

/* Adds the structure or block that is a variable's type. */
static bool want_type(struct wanted *wanted, const struct project *project,
		      const struct var *var)
{
	bool fresh = false;

	if (var->type != IEC_NONE)
		return false;
	for (int i = 0; i < wanted->structures; i++)
		if (project->structure[i].word == var->fb)
			fresh = want(wanted->structure, i) || fresh;
	for (int i = 0; i < wanted->pous; i++)
		if (project->pou[i].word == var->fb && var->fb != WORD_COUNT)
			fresh = want(wanted->pou, i) || fresh;
	return fresh;
}

static bool want_types(struct wanted *wanted, const struct project *project)
{
	bool fresh = false;

	for (int i = 0; i < wanted->globals; i++)
		if (wanted->global[i])
			fresh = want_type(wanted, project, &project->globals.var[i]) || fresh;
	for (int n = 0; n < wanted->structures; n++)
		for (int i = 0; wanted->structure[n] &&
		     i < project->structure[n].vars.count; i++)
			fresh = want_type(wanted, project,
					  &project->structure[n].vars.var[i]) || fresh;
	for (int n = 0; n < wanted->pous; n++)
		for (int i = 0; wanted->pou[n] && i < project->pou[n].vars.count; i++)
			fresh = want_type(wanted, project,
					  &project->pou[n].vars.var[i]) || fresh;
	return fresh;
}

static bool want_target(struct wanted *wanted, const struct xref_target *target)
{
	if (target->index < 0)
		return false;
	if (target->what == XREF_VARIABLE && target->table == 0)
		return want(wanted->global, target->index);
	if (target->what == XREF_POU)
		return want(wanted->pou, target->index);
	return target->what == XREF_STRUCTURE && want(wanted->structure, target->index);
}

/* Adds uses of uses until nothing is missing. Fails: no memory. */
static bool want_all(struct wanted *wanted, struct project *project)
{
	struct xref xref = { 0 };
	bool fresh = xref_make(&xref, project);
	const bool good = fresh;

	while (fresh) {
		fresh = want_types(wanted, project);
		for (int i = 0; i < xref.count; i++)
			if (xref.use[i].pou >= 0 && wanted->pou[xref.use[i].pou])
				fresh = want_target(wanted, &xref.use[i].target) || fresh;
	}
	xref_free(&xref);
	return good;
}

/* ---- names that exist already ---- */

static int find_global(const struct project *project, const char *name)
{
	for (int i = 0; i < project->globals.count; i++)
		if (name_equal(project_text(project, project->globals.var[i].name), name))
			return i;
	return -1;
}

static bool is_taken(const struct project *project, const char *name)
{
	bool taken = find_global(project, name) >= 0 ||
		     project_find_pou(project, name, strlen(name)) >= 0;

	for (int i = 0; i < project->structure_count; i++)
		taken = taken || name_equal(project_text(project,
			project->structure[i].name), name);
	return taken;
}

/* A global with the same name, type and address is shared. */
static bool is_shared(const struct project *project, const struct project *from,
		      const struct var *var)
{
	const int at = find_global(project, project_text(from, var->name));
	const struct var *here = at < 0 ? NULL : &project->globals.var[at];

	return here && var->type != IEC_NONE && here->type == var->type &&
	       here->capacity == var->capacity &&
	       var_bytes(here) == var_bytes(var) &&
	       strcmp(project_text(project, here->init_text),
		      project_text(from, var->init_text)) == 0 &&
	       strcmp(project_text(project, here->at_text),
		      project_text(from, var->at_text)) == 0;
}

static char *free_name(const struct project *project, const struct project *from,
		       const char *name)
{
	char *other = NULL;

	for (int i = 2; !other || is_taken(project, other) || is_taken(from, other); i++) {
		g_free(other);
		other = g_strdup_printf("%s_%d", name, i);
	}
	return other;
}

/* Renames it everywhere in the import. Numbers stay as they are. */
static bool rename_in(struct ladder *from, const struct project *project,
		      const struct xref_target *target, const char *name, GString *told)
{
	char *other = free_name(project, ladder_project(from), name), *kept = g_strdup(name);
	struct ladder_rename how;
	gsize len;
	char *text = ladder_rename(from, target, other, &len, &how);
	const bool good = text && ladder_load_text(from, g_intern_string("import"), text, len);

	if (good)
		g_string_append_printf(told, _("; %s is now %s"), kept, other);
	free(text);
	g_free(other);
	g_free(kept);
	return good;
}

static bool settle(struct ladder *from, const struct project *project,
		   const struct xref_target *target, uint32_t name, GString *told)
{
	const char *text = project_text(ladder_project(from), name);

	return !is_taken(project, text) || rename_in(from, project, target, text, told);
}

static bool settle_names(struct ladder *from, const struct project *project,
			 struct wanted *wanted, GString *told)
{
	bool good = true;

	for (int i = 0; good && i < wanted->globals; i++) {
		const struct xref_target target = xref_variable(ladder_project(from), 0, i);
		const struct var *var = &ladder_project(from)->globals.var[i];

		if (wanted->global[i] && is_shared(project, ladder_project(from), var))
			wanted->global[i] = false;
		else if (wanted->global[i])
			good = settle(from, project, &target, var->name, told);
	}
	for (int i = 0; good && i < wanted->pous; i++) {
		const struct xref_target target = { .what = XREF_POU, .index = i };

		if (wanted->pou[i])
			good = settle(from, project, &target,
				      ladder_project(from)->pou[i].name, told);
	}
	for (int i = 0; good && i < wanted->structures; i++) {
		const struct xref_target target = { .what = XREF_STRUCTURE, .index = i };

		if (wanted->structure[i] && ladder_project(from)->structure[i].name)
			good = settle(from, project, &target,
				      ladder_project(from)->structure[i].name, told);
	}
	return good;
}

/* ---- its text ---- */

static void take_span(void *context, const struct text_span *span)
{
	g_array_append_val((GArray *)context, *span);
}

static void append(GString *out, const char *text, const struct text_span *span)
{
	g_string_append_len(out, text + span->at, (gssize)span->len);
	if (out->str[out->len - 1] != '\n')
		g_string_append_c(out, '\n');
}

static void append_structures(GString *out, const char *text, const GArray *spans,
			      const struct wanted *wanted)
{
	bool any = false;

	for (guint i = 0; i < spans->len; i++) {
		const struct text_span *span = &g_array_index(spans, struct text_span, i);

		if (span->part != TEXT_STRUCT || !wanted->structure[span->number])
			continue;
		g_string_append(out, any ? "" : "\nTYPE\n");
		append(out, text, span);
		any = true;
	}
	g_string_append(out, any ? "END_TYPE\n" : "");
}

/* The line "VAR RETAIN" of a block, behind the comments above it. */
static const char *heading_of(const char *at)
{
	while (!g_str_has_prefix(at, "VAR") && strchr(at, '\n'))
		at = strchr(at, '\n') + 1;
	return at;
}

/* Copies the wanted globals, each block with its own heading. */
static void append_globals(GString *out, const char *text, const GArray *spans,
			   const struct wanted *wanted)
{
	GString *some = g_string_new(NULL);

	for (guint i = 0; i < spans->len; i++) {
		const struct text_span *span = &g_array_index(spans, struct text_span, i);
		const char *at = text + span->at;

		if (span->pou >= 0 || span->structure >= 0)
			continue;
		if (span->part == TEXT_VAR && wanted->global[span->number])
			append(some, text, span);
		if (span->part != TEXT_BLOCK || !some->len)
			continue;
		at = heading_of(at);
		g_string_append_printf(out, "\n%.*s\n%sEND_VAR\n", (int)strcspn(at, "\n"),
				       at, some->str);
		g_string_truncate(some, 0);
	}
	g_string_free(some, TRUE);
}

static char *text_of(struct ladder *from, const struct wanted *wanted)
{
	GArray *spans = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	GString *out = g_string_new(NULL);
	gsize len;
	char *text = ladder_outline(from, &len, take_span, spans);

	append_structures(out, text, spans, wanted);
	append_globals(out, text, spans, wanted);
	for (guint i = 0; i < spans->len; i++) {
		const struct text_span *span = &g_array_index(spans, struct text_span, i);

		if (span->part == TEXT_POU && wanted->pou[span->number]) {
			const struct project *project = ladder_project(from);
			const char *comment = project_text(project,
				project->pou[span->number].comment);

			g_string_append_printf(out, *comment ? "\n%s\n" : "\n", comment);
			append(out, text, span);
		}
	}
	g_array_unref(spans);
	free(text);
	return g_string_free(out, FALSE);
}

/* ---- all of it ---- */

static bool bring(LadderDocument *document, struct ladder *from,
		  const struct wanted *wanted, GString *told)
{
	struct diag_list why;
	char *text = text_of(from, wanted), *all;
	gsize len;
	bool good;

	all = ladder_document_outline(document, &len, NULL, NULL);
	ladder_document_begin(document, _("Import"), NULL);
	good = all && ladder_document_replace(document, len, 0, text, &why);
	ladder_document_end(document);
	if (!good) {
		char *reason = all && why.count ? diag_said_whole(&why.diag[0]) :
						  g_strdup("");

		g_string_printf(told, _("Nothing was imported: %s"), reason);
		g_free(reason);
	}
	g_free(all);
	g_free(text);
	return good;
}

bool pou_import(LadderDocument *document, struct ladder *from, const bool *chosen,
		GString *told)
{
	const struct project *project = ladder_document_project(document);
	const struct project *other = ladder_project(from);
	struct wanted wanted = { .pous = other->pou_count, .globals = other->globals.count,
				 .structures = other->structure_count };
	bool good;

	if (!project)
		return false;
	wanted.pou = g_memdup2(chosen, (gsize)wanted.pous * sizeof(bool));
	wanted.global = g_new0(bool, wanted.globals + 1);
	wanted.structure = g_new0(bool, wanted.structures + 1);
	g_string_assign(told, _("Imported"));
	good = want_all(&wanted, ladder_project(from)) &&
	       settle_names(from, project, &wanted, told) &&
	       bring(document, from, &wanted, told);
	g_free(wanted.pou);
	g_free(wanted.global);
	g_free(wanted.structure);
	return good;
}

/* ---- what would be imported ---- */

static void add_name(GString *out, const struct project *project, uint32_t name)
{
	g_string_append_printf(out, "%s%s", out->len ? ", " : "", project_text(project, name));
}

/* The names of all that these POUs of @from need, themselves included:
 * "Motor, Seal, Lamp". Caller frees. */
static char *pou_import_needs(struct ladder *from, const bool *chosen)
{
	struct project *project = ladder_project(from);
	struct wanted wanted = { .pous = project->pou_count, .globals = project->globals.count,
				 .structures = project->structure_count };
	GString *out = g_string_new(NULL);

	wanted.pou = g_memdup2(chosen, (gsize)wanted.pous * sizeof(bool));
	wanted.global = g_new0(bool, wanted.globals + 1);
	wanted.structure = g_new0(bool, wanted.structures + 1);
	if (want_all(&wanted, project)) {
		for (int i = 0; i < wanted.pous; i++)
			if (wanted.pou[i])
				add_name(out, project, project->pou[i].name);
		for (int i = 0; i < wanted.structures; i++)
			if (wanted.structure[i] && project->structure[i].name)
				add_name(out, project, project->structure[i].name);
		for (int i = 0; i < wanted.globals; i++)
			if (wanted.global[i])
				add_name(out, project, project->globals.var[i].name);
	}
	g_free(wanted.pou);
	g_free(wanted.global);
	g_free(wanted.structure);
	return g_string_free(out, FALSE);
}

/* ---- from a document to a file ---- */

/* A copy of the document, whose parts may be renamed. NULL: it cannot be read. */
static struct ladder *copy_of(LadderDocument *document)
{
	struct ladder *copy = ladder_document_reader(document);
	gsize len;
	char *text = ladder_document_text(document, &len);
	const bool good = ladder_load_text(copy, g_intern_string(ladder_document_file(document)), text,
						   len) && ladder_project(copy);

	g_free(text);
	if (good)
		return copy;
	ladder_free(copy);
	return NULL;
}

static bool *only(struct ladder *from, int pou)
{
	bool *chosen = g_new0(bool, ladder_project(from)->pou_count + 1);

	chosen[pou] = true;
	return chosen;
}

char *pou_export_needs(LadderDocument *document, int pou)
{
	struct ladder *from = copy_of(document);
	bool *chosen = from ? only(from, pou) : NULL;
	char *needs = from ? pou_import_needs(from, chosen) : g_strdup("");

	g_free(chosen);
	ladder_free(from);
	return needs;
}

/* Why a POU cannot go to this file; NULL: it can. */
static const char *target_refusal(LadderDocument *document, const char *path)
{
	const char *own = ladder_document_path(document);

	if (own && disk_same(own, path))
		return _("This is the file of this project. Choose another.");
	return ladder_document_includes(document, path) ?
	       _("This project includes the file. Choose another.") : NULL;
}

/* Imports POU @pou of @document into @other. */
static bool give(LadderDocument *document, int pou, LadderDocument *other, GString *told)
{
	struct ladder *from = copy_of(document);
	bool *chosen = from ? only(from, pou) : NULL;
	bool good = from && ladder_document_project(other);

	if (!good)
		g_string_assign(told, _("Cannot read the file as a project. Open it to see why."));
	good = good && pou_import(other, from, chosen, told);
	g_free(chosen);
	ladder_free(from);
	return good;
}

bool pou_export(LadderDocument *document, int pou, const char *path, GString *told)
{
	const char *why = target_refusal(document, path);
	LadderDocument *other = ladder_document_new();
	GError *error = NULL;
	const bool good = !why && ladder_document_open(other, path, &error) &&
		give(document, pou, other, told) && ladder_document_save(other, NULL, &error);

	if (why)
		g_string_assign(told, why);
	if (error)
		g_string_assign(told, error->message);
	g_clear_error(&error);
	g_object_unref(other);
	return good;
}

char *pou_export_text(LadderDocument *document, int pou, LadderSideFile *file, GString *told)
{
	LadderDocument *other = ladder_document_new();
	char *text = ladder_side_file_text(file), *all = NULL;

	ladder_document_open_text(other, ladder_side_file_path(file), text, strlen(text), true);
	if (give(document, pou, other, told))
		all = ladder_document_text(other, NULL);
	g_object_unref(other);
	g_free(text);
	return all;
}
