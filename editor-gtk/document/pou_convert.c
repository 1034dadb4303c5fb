/* SPDX-License-Identifier: MIT
 *
 * pou_convert - a POU in another language; see pou_convert.h.
 *
 * All is done in copies of the project, because some conversions of the engine use theirs up. A result
 * is read and built again: a name may have another meaning in the other language.
 */
#include "editor-gtk/document/pou_convert.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include <stdlib.h>
#include <string.h>

/* A built copy of the project, and which of its POUs are converted. */
struct copy {
	struct ladder *ladder;
	const char *file;
	uint8_t *wanted;         /* a byte a POU                                   */
	int pou;                 /* the first of them                              */
};

/* ---- copies ---- */

/* The reasons outlive the copy that they speak of. */
static void take_reasons(struct diag_list *why, const struct diag_list *from)
{
	*why = *from;
	for (int i = 0; i < why->count; i++) {
		why->diag[i].file = g_intern_string(why->diag[i].file);
		why->diag[i].pou = g_intern_string(why->diag[i].pou);
	}
}

static const char *file_of(LadderDocument *document)
{
	return g_intern_string(ladder_document_file(document));
}

/* Reads and builds @text. NULL: it has errors, which @why gets. */
static struct ladder *build(LadderDocument *document, const char *text, struct diag_list *why)
{
	struct ladder *ladder = ladder_document_reader(document);

	if (ladder_load_text(ladder, file_of(document), text, strlen(text)) && ladder_build(ladder))
		return ladder;
	take_reasons(why, ladder_diags(ladder));
	ladder_free(ladder);
	return NULL;
}

static const struct project *project_of(const struct copy *copy)
{
	return ladder_project(copy->ladder);
}

bool pou_is_made(const struct project *before, const char *name, const struct project *after, int i)
{
	const char *other = project_text(after, after->pou[i].name);
	const int was = project_find_pou(before, other, strlen(other));

	return was < 0 || was == project_find_pou(before, name, strlen(name));
}

/* Which POUs of the copy come from POU @name of @before. */
static void choose(struct copy *copy, const struct project *before, const char *name)
{
	const int count = project_of(copy)->pou_count;

	copy->wanted = g_new0(uint8_t, count + 1);
	for (int i = count - 1; i >= 0; i--) {
		copy->wanted[i] = pou_is_made(before, name, project_of(copy), i);
		if (copy->wanted[i])
			copy->pou = i;
	}
}

static void copy_clear(struct copy *copy)
{
	ladder_free(copy->ladder);
	g_free(copy->wanted);
}

/* ---- the languages ---- */

/* Structured Text, networks or ladders. */
static char *as_written(struct copy *copy, enum pou_language to, struct diag_list *why)
{
	size_t len;

	return ladder_export_as(copy->ladder, copy->wanted, to, &len, why);
}

static char *as_list(struct copy *copy, enum pou_language to, struct diag_list *why)
{
	size_t len;

	(void)to;
	(void)why;
	return ladder_export_lists(copy->ladder, copy->wanted, &len);
}

#define FROM(language) (1u << LANGUAGE_##language)

/* A language that the engine can write, what it is made of, and what becomes a ladder first. */
static const struct row {
	enum pou_language to;
	unsigned from, by_ladder;
	char *(*write)(struct copy *copy, enum pou_language to, struct diag_list *why);
} rows[] = {
	{ LANGUAGE_LD, FROM(SFC) | FROM(FBD), 0, as_written },
	{ LANGUAGE_ST, FROM(LD) | FROM(FBD), FROM(SFC), as_written },
	{ LANGUAGE_FBD, FROM(LD), FROM(SFC), as_written },
	{ LANGUAGE_IL, FROM(LD) | FROM(FBD) | FROM(ST), FROM(SFC), as_list },
};

/* NULL: nothing becomes @to. */
static const struct row *row_of(enum pou_language to)
{
	for (gsize i = 0; i < G_N_ELEMENTS(rows); i++)
		if (rows[i].to == to)
			return &rows[i];
	return NULL;
}

enum verb pou_convert_verb(enum pou_language to, bool converts)
{
	switch (to) {
	case LANGUAGE_LD: return converts ? VERB_convert_ld : VERB_show_ld;
	case LANGUAGE_IL: return converts ? VERB_convert_il : VERB_show_il;
	case LANGUAGE_ST: return converts ? VERB_convert_st : VERB_show_st;
	case LANGUAGE_FBD: return converts ? VERB_convert_fbd : VERB_show_fbd;
	case LANGUAGE_SFC: break;
	}
	return VERB_COUNT;
}

/* A function main without a language in its heading is run only as Structured Text (model/caller.h). */
static bool is_run_by_itself(const struct project *project, const struct pou *pou)
{
	return pou->kind == POU_FUNCTION && pou->unsaid &&
	       g_ascii_strcasecmp(project_text(project, pou->name), "main") == 0;
}

bool pou_can_become(const struct project *project, int pou, enum pou_language to)
{
	const struct pou *of = &project->pou[pou];
	const struct row *row = row_of(to);

	return row && !of->included && (row->from | row->by_ladder) & 1u << of->language &&
	       (to != LANGUAGE_IL || (!is_run_by_itself(project, of) && !pou_has_any_bounds(of)));
}

/* ---- converting ---- */

static bool refuse(const struct copy *copy, const char *name, enum pou_language to, struct diag_list *why)
{
	const struct pou *pou = &project_of(copy)->pou[copy->pou];

	if (pou->included)
		return diag_add(why, (struct diag){ .id = DIAG_CONVERT_INCLUDED, .line = pou->line, .pou = name,
						    .file = g_intern_string(pou->file) },
				"%s" DIAG_AND "%s", name, pou->file);
	return diag_add(why, (struct diag){ .id = DIAG_CONVERT_LANGUAGE, .file = copy->file, .line = pou->line,
					    .pou = name },
			"%s" DIAG_AND "%s" DIAG_AND "%s", name, pou_language_word(pou->language),
			pou_language_word(to));
}

/* The canonical form of what the engine made. NULL: it has errors, and @why gets the first. Caller: free(). */
static char *finished(LadderDocument *document, const char *made, const char *name, enum pou_language to,
		      struct diag_list *why)
{
	struct diag_list *errors = g_new0(struct diag_list, 1);
	struct ladder *ladder = build(document, made, errors);
	const struct diag *error = diag_first_error(errors);
	char *out = NULL;
	size_t len;

	if (ladder)
		out = ladder_write(ladder, &len);
	else if (error)
		diag_add(why, (struct diag){ .id = DIAG_CONVERT_UNREAD, .file = file_of(document), .pou = name },
			 "%s" DIAG_AND "%s" DIAG_AND "%s" DIAG_AND "%.*s", name, pou_language_word(to),
			 diag_code(error->id), diag_name_length(error), error->arg);
	ladder_free(ladder);
	g_free(errors);
	return out;
}

/* One row on a project in canonical form. NULL: @why. Caller: free(). */
static char *write_row(LadderDocument *document, struct copy *copy, const struct row *row, const char *name,
		       struct diag_list *why)
{
	struct diag_list *reasons = g_new0(struct diag_list, 1);
	char *made = row->write(copy, row->to, reasons), *out = NULL;

	take_reasons(why, reasons);
	if (made)
		out = finished(document, made, name, row->to, why);
	if (!out && !why->errors)
		diag_add(why, (struct diag){ .id = DIAG_NO_MEMORY, .file = copy->file }, "%s", "");
	free(made);
	g_free(reasons);
	return out;
}

/* @text: of the project. @first: gets whether it is only a ladder yet. NULL: @why. Caller: free(). */
static char *convert_text(LadderDocument *document, const char *text, const char *name,
			  enum pou_language to, bool *first, struct diag_list *why)
{
	struct copy copy = { .ladder = build(document, text, why), .file = file_of(document), .pou = -1 };
	const struct row *row = row_of(to);
	const struct pou *pou;
	char *out = NULL;

	*first = false;
	if (copy.ladder)
		choose(&copy, ladder_document_project(document), name);
	if (copy.pou < 0) {
		copy_clear(&copy);
		return NULL;
	}
	pou = &project_of(&copy)->pou[copy.pou];
	*first = row && row->by_ladder & 1u << pou->language;
	if (!pou_can_become(project_of(&copy), copy.pou, to))
		refuse(&copy, name, to, why);
	else
		out = write_row(document, &copy, *first ? row_of(LANGUAGE_LD) : row, name, why);
	copy_clear(&copy);
	return out;
}

/* Places in the ladder between are no places of the document: only the POU remains. */
static void forget_places(struct diag_list *why, const char *name)
{
	for (int i = 0; i < why->count; i++) {
		struct diag *diag = &why->diag[i];

		diag->line = diag->rung = diag->row = diag->col = diag->column = 0;
		diag->pou = name;
	}
}

char *pou_converted(LadderDocument *document, int pou, enum pou_language to, struct diag_list *why)
{
	const struct project *project = ladder_document_project(document);
	const char *name = g_intern_string(project_text(project, project->pou[pou].name));
	char *text = ladder_document_text(document, NULL), *out, *second;
	bool first;

	diag_init(why);
	out = convert_text(document, text, name, to, &first, why);
	g_free(text);
	if (!out || !first)
		return out;
	second = convert_text(document, out, name, to, &first, why);
	free(out);
	forget_places(why, name);
	return second;
}

bool pou_convert(LadderDocument *document, int pou, enum pou_language to, struct diag_list *why)
{
	char *text = pou_converted(document, pou, to, why), *step;
	bool good = false;
	gsize len;

	if (!text)
		return false;
	g_free(ladder_document_outline(document, &len, NULL, NULL));
	step = g_strdup_printf(_("Convert to %s"), pou_language_word(to));
	ladder_document_begin(document, step, NULL);
	good = ladder_document_replace(document, 0, len, text, why);
	ladder_document_end(document);
	g_free(step);
	free(text);
	return good;
}
