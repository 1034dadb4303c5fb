/* SPDX-License-Identifier: MIT
 *
 * type_edit - edits of data types as changes of the canonical text.
 */
#include "editor-gtk/document/type_edit.h"

#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/document/rename.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <string.h>

static bool refuse(char **why, char *text)
{
	*why = text;
	return false;
}

/* ---- what there is ---- */

/* NULL: it is a structure. */
static const struct named_type *named_of(const struct project *project, int type)
{
	return type < project->structure_count ? NULL :
	       &project->named[type - project->structure_count];
}

int type_count(const struct project *project)
{
	return project->structure_count + project->named_count;
}

bool type_is(const struct project *project, int type)
{
	if (type < 0 || type >= type_count(project))
		return false;
	return type < project->structure_count ? project->structure[type].name != 0 :
						 named_of(project, type)->like.var != NULL;
}

const char *type_name(const struct project *project, int type)
{
	const struct named_type *named = named_of(project, type);

	return project_text(project, named ? named->name : project->structure[type].name);
}

const struct var *type_like(const struct project *project, int type)
{
	return type < project->structure_count ? NULL : named_of(project, type)->like.var;
}

enum type_kind type_kind_of(const struct project *project, int type)
{
	const struct var *like = type_like(project, type);

	if (!like)
		return TYPE_STRUCTURE;
	if (like->own_dims || like->array.count)
		return like->own_dims || !like->named ? TYPE_ARRAY : TYPE_ALIAS;
	if (like->named)
		return TYPE_ALIAS;
	return like->enumeration ? TYPE_ENUMERATION : like->range ? TYPE_SUBRANGE : TYPE_ALIAS;
}

const char *type_kind_name(enum type_kind kind)
{
	static const char *const name[TYPE_KINDS] = {
		[TYPE_STRUCTURE] = N_("structure"), [TYPE_ENUMERATION] = N_("enumeration"),
		[TYPE_SUBRANGE] = N_("subrange"), [TYPE_ARRAY] = N_("array"),
		[TYPE_ALIAS] = N_("other name of a type"),
	};

	return _(name[kind]);
}

int type_find(LadderDocument *document, const char *name)
{
	const struct project *project = ladder_document_project(document);

	for (int i = 0; project && i < type_count(project); i++)
		if (type_is(project, i) && name_equal(type_name(project, i), name))
			return i;
	return -1;
}

int type_table(LadderDocument *document, int type)
{
	return ladder_document_project(document)->pou_count + 1 + type;
}

struct xref_target type_target(const struct project *project, int type)
{
	const bool structure = type < project->structure_count;

	return (struct xref_target){ .what = structure ? XREF_STRUCTURE : XREF_NAMED,
				     .index = structure ? type : type - project->structure_count };
}

/* Of each part first what stands above its first structure. */
GArray *type_order(const struct project *project)
{
	GArray *order = g_array_new(FALSE, FALSE, sizeof(int));

	for (int structure = 0; structure <= project->structure_count; structure++) {
		for (int i = 0; i < project->named_count; i++) {
			const int type = project->structure_count + i;

			if (project->named[i].before == structure && type_is(project, type))
				g_array_append_val(order, type);
		}
		if (structure < project->structure_count && type_is(project, structure))
			g_array_append_val(order, structure);
	}
	return order;
}

/* The part TYPE … END_TYPE that declares it. */
static const struct part *part_with(const struct project *project, int structure)
{
	const struct named_type *named = named_of(project, structure);

	if (named)
		return named->part < project->part_count ? &project->part[named->part] : NULL;
	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->kind == PART_TYPES && structure >= part->index &&
		    structure < part->index + part->count)
			return part;
	}
	return NULL;
}

bool type_is_included(LadderDocument *document, int structure)
{
	const struct part *part = part_with(ladder_document_project(document), structure);

	return !part || part->included;
}

/* ---- the text ---- */

struct outline {
	const struct project *project;
	char *text;
	gsize len;
	GArray *span;        /* of struct text_span                           */
};

static void take_span(void *context, const struct text_span *span)
{
	g_array_append_val((GArray *)context, *span);
}

static void outline_make(struct outline *outline, LadderDocument *document)
{
	outline->project = ladder_document_project(document);
	outline->span = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	outline->text = ladder_document_outline(document, &outline->len, take_span,
						outline->span);
}

static void outline_clear(struct outline *outline)
{
	g_array_unref(outline->span);
	g_free(outline->text);
}

/* NULL: it is not in this file. */
static const struct text_span *find_span(const struct outline *outline, enum text_part part,
					 int structure, int number)
{
	for (guint i = 0; i < outline->span->len; i++) {
		const struct text_span *span = &g_array_index(outline->span,
							      struct text_span, i);

		if (span->part == part && span->number == number &&
		    span->structure == structure)
			return span;
	}
	return NULL;
}

static const struct text_span *structure_span(const struct outline *outline, int structure)
{
	return find_span(outline, TEXT_STRUCT, structure, structure);
}

/* Replaces a piece of the text as one step. */
static bool put(LadderDocument *document, gsize at, gsize removed, const char *with,
		const char *step, char **why)
{
	*why = ladder_document_replace_step(document, at, removed, with, step);
	return !*why;
}

static bool is_readable(LadderDocument *document, char **why)
{
	return (ladder_document_project(document) && ladder_document_is_whole(document)) ||
	       refuse(why, g_strdup(_("Nothing can be changed until the whole project can be read. Correct its errors first")));
}

/* ---- names ---- */

char *type_name_refusal(LadderDocument *document, const char *name)
{
	struct project *project = ladder_document_project(document);
	const enum diag_id fault = ladder_name_fault(name);

	if (!*name)
		return g_strdup(_("Enter a name"));
	if (fault == DIAG_EXPECTED)
		return g_strdup_printf(_("“%s” is not a name"), name);
	if (fault != DIAG_COUNT && fault != DIAG_SHADOWS_ADDRESS)
		return diag_said_of(fault, name);
	if (type_find(document, name) >= 0 || project_find_pou(project, name, strlen(name)) >= 0)
		return g_strdup_printf(_("“%s” is declared already"), name);
	if (words_is_taken(name))
		return g_strdup_printf(_("“%s” is a word of the language"), name);
	for (int i = 0; i < project->globals.count; i++)
		if (name_equal(name, project_text(project,
				project->globals.var[i].name)))
			return g_strdup_printf(_("“%s” is declared already"), name);
	return NULL;
}

char *type_free_name(LadderDocument *document, const char *like)
{
	char *stem = g_strdup(like), *name = g_strdup(like), *why;
	gsize len = strlen(stem);

	while (len > 1 && g_ascii_isdigit(stem[len - 1]))
		stem[--len] = '\0';
	for (int i = 2; (why = type_name_refusal(document, name)) && i < LIMIT_OWN_WORDS; i++) {
		g_free(why);
		g_free(name);
		name = g_strdup_printf("%s%d", stem, i);
	}
	g_free(why);
	g_free(stem);
	return name;
}

/* ---- adding ---- */

/* A new part TYPE goes before the first declaration, program or configuration. */
static gsize place_of_types(const struct outline *outline)
{
	for (guint i = 0; i < outline->span->len; i++) {
		const struct text_span *span = &g_array_index(outline->span,
							      struct text_span, i);
		enum part_kind kind = span->part == TEXT_PART ?
			outline->project->part[span->number].kind : PART_INCLUDE;

		if (kind != PART_INCLUDE && kind != PART_USES)
			return span->at;
	}
	return outline->len;
}

/* The last type of this file; NULL: none. */
static const struct text_span *last_type(const struct outline *outline)
{
	const struct text_span *last = NULL;

	for (int i = 0; i < type_count(outline->project); i++) {
		const struct text_span *span = structure_span(outline, i);

		if (span && (!last || span->at > last->at))
			last = span;
	}
	return last;
}

bool type_add(LadderDocument *document, enum type_kind kind, const char *name, char **why)
{
	static const char *const like[TYPE_KINDS] = {
		[TYPE_STRUCTURE] = "STRUCT\n    Member1 : INT;\n  END_STRUCT",
		[TYPE_ENUMERATION] = "(Value1, Value2)", [TYPE_SUBRANGE] = "INT (0..100)",
		[TYPE_ARRAY] = "ARRAY[0..9] OF INT", [TYPE_ALIAS] = "INT",
	};
	struct outline outline;
	const struct text_span *last;
	char *text;
	bool good;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	*why = type_name_refusal(document, name);
	if (*why)
		return false;
	outline_make(&outline, document);
	last = last_type(&outline);
	text = g_strdup_printf(last ? "  %s : %s;\n" : "TYPE\n  %s : %s;\nEND_TYPE\n\n", name,
			       like[kind]);
	good = put(document, last ? last->at + last->len : place_of_types(&outline), 0, text,
		   _("New data type"), why);
	g_free(text);
	outline_clear(&outline);
	return good;
}

bool type_duplicate(LadderDocument *document, int structure, const char *name, char **why)
{
	struct outline outline;
	const struct text_span *span;
	gsize head;
	char *text;
	bool good = false;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	*why = type_name_refusal(document, name);
	if (*why)
		return false;
	outline_make(&outline, document);
	span = structure_span(&outline, structure);
	if (span) {
		head = strlen("  ") + strlen(type_name(outline.project, structure));
		text = g_strdup_printf("  %s%.*s", name, (int)(span->len - head),
				       outline.text + span->at + head);
		good = put(document, span->at + span->len, 0, text, _("Duplicate data type"),
			   why);
		g_free(text);
	} else {
		refuse(why, g_strdup(_("It is declared in another file")));
	}
	outline_clear(&outline);
	return good;
}

/* ---- deleting ---- */

/* A value of the enumeration that @type declares? */
static bool is_value_of(const struct project *project, const struct xref_target *target, int type)
{
	const struct var *like = type_like(project, type);

	return like && target->what == XREF_VALUE && !like->named &&
	       project->enum_value[target->index].enumeration + 1 == like->enumeration;
}

int type_uses(LadderDocument *document, int structure)
{
	struct project *project = ladder_document_project(document);
	const struct xref_target target = type_target(project, structure);
	const struct var *like = type_like(project, structure);
	struct xref xref = { 0 };
	int count = 0;

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		count += use->kind != XREF_DECLARED && (!like || use->slot != &like->init_text) &&
			 (xref_same(&use->target, &target) ||
			  is_value_of(project, &use->target, structure));
	}
	xref_free(&xref);
	return count;
}

/* Is the variable declared as @type, or as a pointer to it? */
static bool is_of(const struct project *project, const struct var *var, int type)
{
	while (var->target && !var->named)
		var = var->target->like;
	if (var->named)
		return var->named - 1 == type - project->structure_count;
	return type < project->structure_count && var->type == IEC_NONE &&
	       var->fb == project->structure[type].word;
}

/* Names what stays but cannot be read without the type: a structure that has no other
 * members, another type, or a function that returns it. NULL: none. Caller frees. */
static char *holder(const struct project *project, int type)
{
	for (int i = 0; i < project->structure_count; i++) {
		const struct var_table *vars = &project->structure[i].vars;
		int others = 0;

		for (int k = 0; k < vars->count; k++)
			others += !is_of(project, &vars->var[k], type);
		if (i != type && vars->count && !others)
			return g_strdup_printf(_("“%s” would have no member without it"),
				project_text(project, project->structure[i].name));
	}
	for (int i = project->structure_count; i < type_count(project); i++)
		if (i != type && type_is(project, i) && is_of(project, type_like(project, i), type))
			return g_strdup_printf(_("“%s” is made of it"), type_name(project, i));
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_FUNCTION && project->pou[i].vars.count &&
		    is_of(project, &project->pou[i].vars.var[0], type))
			return g_strdup_printf(_("“%s” returns it"),
				project_text(project, project->pou[i].name));
	return NULL;
}

/* So many types are in a part TYPE. */
static int types_in(const struct project *project, const struct part *part)
{
	int count = part->count;

	for (int i = 0; i < project->named_count; i++)
		count += project->named[i].part == part - project->part &&
			 project->named[i].like.var;
	return count;
}

/* The part TYPE if nothing else is in it, else the type. */
static struct text_span deleted_span(const struct outline *outline, int structure)
{
	const struct part *part = part_with(outline->project, structure);

	if (types_in(outline->project, part) == 1)
		return *find_span(outline, TEXT_PART, -1,
				  (int)(part - outline->project->part));
	return *structure_span(outline, structure);
}

bool type_delete(LadderDocument *document, int structure, char **why)
{
	struct outline outline;
	struct text_span span;
	char *name;
	bool good;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	if (type_is_included(document, structure))
		return refuse(why, g_strdup(_("It is declared in another file")));
	*why = holder(ladder_document_project(document), structure);
	if (*why)
		return false;
	outline_make(&outline, document);
	span = deleted_span(&outline, structure);
	name = g_strdup(type_name(outline.project, structure));
	outline_clear(&outline);
	ladder_document_begin(document, _("Delete data type"), NULL);
	good = pou_delete_text(document, &span, name);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	g_free(name);
	return good || refuse(why, g_strdup(_("Another file uses it and could not be read without it")));
}

/* ---- members ---- */

bool type_move_member(LadderDocument *document, int structure, int from, int to, char **why)
{
	struct outline outline;
	const struct text_span *moved, *other;
	char *text;
	gsize at, len;
	bool good = true;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	if (from == to)
		return true;
	outline_make(&outline, document);
	moved = find_span(&outline, TEXT_VAR, structure, from);
	other = find_span(&outline, TEXT_VAR, structure, to);
	if (!moved || !other) {
		good = refuse(why, g_strdup(_("It is declared in another file")));
	} else {
		at = MIN(moved->at, other->at);
		len = MAX(moved->at + moved->len, other->at + other->len) - at;
		text = to < from ?
			g_strdup_printf("%.*s%.*s", (int)moved->len, outline.text + moved->at,
				(int)(moved->at - at), outline.text + at) :
			g_strdup_printf("%.*s%.*s", (int)(at + len - moved->at - moved->len),
				outline.text + moved->at + moved->len, (int)moved->len,
				outline.text + moved->at);
		good = put(document, at, len, text, _("Move member"), why);
		g_free(text);
	}
	outline_clear(&outline);
	return good;
}

bool type_add_member(LadderDocument *document, int structure, int behind, char **name,
		     char **why)
{
	const struct project *project = ladder_document_project(document);
	const char *text[SYMBOL_FIELDS] = { "", "", "", "", "", "", "" };
	const struct var_table *vars;
	struct symbol_row *row;
	int table, count;
	bool good;

	*why = NULL;
	*name = NULL;
	if (!is_readable(document, why))
		return false;
	table = type_table(document, structure);
	vars = &project->structure[structure].vars;
	count = vars->count;
	row = symbol_row_new(project, vars, table, CLAMP(behind, 0, count - 1));
	*name = symbol_free_name(document, table, row->text[FIELD_NAME]);
	text[FIELD_NAME] = *name;
	text[FIELD_TYPE] = row->text[FIELD_TYPE];
	ladder_document_begin(document, _("Add member"), NULL);
	good = symbol_add(document, table, 0, text, why) &&
	       type_move_member(document, structure, count, behind + 1, why);
	if (good)
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	symbol_row_free(row);
	return good;
}

/* ---- values, bounds ---- */

/* What stands behind the colon of an enumeration or a subrange. */
struct written_type {
	char *base;              /* "": of an enumeration that names none          */
	GPtrArray *name, *number; /* of its values; a number may be ""             */
	char *low, *high;        /* of a subrange                                  */
};

char *type_base(const struct project *project, int type)
{
	const struct var *like = type_like(project, type);

	if (like->enumeration && !project->enumeration[like->enumeration - 1].based)
		return g_strdup("");
	return g_strdup(iec_type_row(like->type)->word);
}

char *type_bound(const struct project *project, int type, bool high)
{
	const struct var *like = type_like(project, type);
	const struct var_written *written = like->written;

	if (written && written->range[high])
		return g_strdup(project_text(project, written->range[high]));
	return g_strdup_printf("%lld", (long long)(high ? like->range->high : like->range->low));
}

static void written_read(struct written_type *written, const struct project *project, int type)
{
	const struct var *like = type_like(project, type);
	const struct enumeration *list = like->enumeration ?
		&project->enumeration[like->enumeration - 1] : NULL;

	*written = (struct written_type){ .base = type_base(project, type),
		.name = g_ptr_array_new_with_free_func(g_free),
		.number = g_ptr_array_new_with_free_func(g_free) };
	for (int i = 0; list && i < list->count; i++) {
		const struct enum_value *value = &project->enum_value[list->first + i];

		g_ptr_array_add(written->name, g_strdup(project_text(project, value->name)));
		g_ptr_array_add(written->number, g_strdup(project_text(project, value->text)));
	}
	if (!list && like->range) {
		written->low = type_bound(project, type, false);
		written->high = type_bound(project, type, true);
	}
}

static void written_clear(struct written_type *written)
{
	g_free(written->base);
	g_free(written->low);
	g_free(written->high);
	g_ptr_array_unref(written->name);
	g_ptr_array_unref(written->number);
}

/* "UINT (Off := 1, Slow)", "INT (0..100)". Caller frees. */
static char *written_text(const struct written_type *written)
{
	GString *text = g_string_new(written->base);

	if (!written->name->len) {
		g_string_append_printf(text, " (%s..%s)", written->low, written->high);
		return g_string_free(text, FALSE);
	}
	for (guint i = 0; i < written->name->len; i++) {
		const char *number = written->number->pdata[i];

		g_string_append_printf(text, "%s%s%s%s", i ? ", " : *written->base ? " (" : "(",
				       (const char *)written->name->pdata[i],
				       *number ? " := " : "", number);
	}
	return g_string_free(g_string_append_c(text, ')'), FALSE);
}

static bool written_put(LadderDocument *document, int type, struct written_type *written,
			char **why)
{
	char *text = written_text(written);
	const bool good = symbol_set(document, type_table(document, type), 0, FIELD_TYPE, text, why);

	g_free(text);
	written_clear(written);
	return good;
}

static bool begin_written(LadderDocument *document, int type, struct written_type *written,
			  char **why)
{
	*why = NULL;
	if (!is_readable(document, why))
		return false;
	if (type_is_included(document, type))
		return refuse(why, g_strdup(_("It is declared in another file")));
	written_read(written, ladder_document_project(document), type);
	return true;
}

bool type_set_base(LadderDocument *document, int type, const char *base, char **why)
{
	struct written_type written;

	if (!begin_written(document, type, &written, why))
		return false;
	g_free(written.base);
	written.base = g_strstrip(g_strdup(base));
	return written_put(document, type, &written, why);
}

bool type_set_bound(LadderDocument *document, int type, bool high, const char *text, char **why)
{
	struct written_type written;
	char **bound;

	if (!begin_written(document, type, &written, why))
		return false;
	bound = high ? &written.high : &written.low;
	g_free(*bound);
	*bound = g_strstrip(g_strdup(text));
	return written_put(document, type, &written, why);
}

int type_value(const struct project *project, int type, int index)
{
	const struct var *like = type_like(project, type);
	const struct enumeration *list = like && like->enumeration ?
		&project->enumeration[like->enumeration - 1] : NULL;

	return list && index >= 0 && index < list->count ? list->first + index : -1;
}

bool type_rename_value(LadderDocument *document, int type, int index, const char *name, char **why)
{
	const struct project *project = ladder_document_project(document);
	struct xref_target target = { .what = XREF_VALUE };
	char *clean;
	bool good;

	*why = NULL;
	if (!is_readable(document, why))
		return false;
	target.index = type_value(project, type, index);
	if (target.index < 0)
		return refuse(why, g_strdup(_("It is not there any more")));
	clean = g_strstrip(g_strdup(name));
	good = strcmp(clean, project_text(project, project->enum_value[target.index].name)) == 0 ||
	       rename_everywhere(document, &target, clean, _("Rename value"), NULL, why);
	g_free(clean);
	return good;
}

bool type_set_number(LadderDocument *document, int type, int index, const char *number, char **why)
{
	struct written_type written;

	*why = NULL;
	if (strpbrk(number, ",;:()"))
		return refuse(why, g_strdup(_("A whole number is needed")));
	if (!begin_written(document, type, &written, why))
		return false;
	if (index < 0 || index >= (int)written.number->len) {
		written_clear(&written);
		return refuse(why, g_strdup(_("It is not there any more")));
	}
	g_free(written.number->pdata[index]);
	written.number->pdata[index] = g_strstrip(g_strdup(number));
	return written_put(document, type, &written, why);
}

static bool has_value(const struct project *project, const char *name)
{
	for (int i = 0; i < project->enum_value_count; i++)
		if (name_equal(project_text(project, project->enum_value[i].name), name))
			return true;
	return false;
}

bool type_add_value(LadderDocument *document, int type, int behind, char **name, char **why)
{
	const struct project *project = ladder_document_project(document);
	struct written_type written;

	*name = NULL;
	if (!begin_written(document, type, &written, why))
		return false;
	behind = CLAMP(behind, -1, (int)written.name->len - 1);
	for (int i = 1; !*name || has_value(project, *name); i++) {
		g_free(*name);
		*name = g_strdup_printf("Value%d", i);
	}
	g_ptr_array_insert(written.name, behind + 1, g_strdup(*name));
	g_ptr_array_insert(written.number, behind + 1, g_strdup(""));
	return written_put(document, type, &written, why);
}

bool type_delete_value(LadderDocument *document, int type, int index, char **why)
{
	struct written_type written;

	if (!begin_written(document, type, &written, why))
		return false;
	if (index < 0 || index >= (int)written.name->len || written.name->len < 2) {
		refuse(why, g_strdup(written.name->len < 2 ? _("An enumeration needs a value") :
							     _("It is not there any more")));
		written_clear(&written);
		return false;
	}
	g_ptr_array_remove_index(written.name, (guint)index);
	g_ptr_array_remove_index(written.number, (guint)index);
	return written_put(document, type, &written, why);
}

static void shift(GPtrArray *texts, int from, int to)
{
	g_ptr_array_insert(texts, to, g_ptr_array_steal_index(texts, (guint)from));
}

bool type_move_value(LadderDocument *document, int type, int from, int to, char **why)
{
	struct written_type written;

	if (!begin_written(document, type, &written, why))
		return false;
	if (MIN(from, to) < 0 || MAX(from, to) >= (int)written.name->len) {
		written_clear(&written);
		return refuse(why, g_strdup(_("It is not there any more")));
	}
	shift(written.name, from, to);
	shift(written.number, from, to);
	return written_put(document, type, &written, why);
}
