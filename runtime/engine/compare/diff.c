/* SPDX-License-Identifier: MIT
 *
 * diff - two projects compared: names, variables, POUs, kept sections.
 *
 * What the parts do not find, such as another order of declarations, shows in
 * the canonical texts, which are compared last: no difference means the same
 * text.
 */
#include "engine/compare/diff.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

uint32_t diff_id(struct diff *diff, const char *text, size_t len)
{
	uint32_t id = len ? names_intern(&diff->names, text, len) : 0;

	if (len > 0 && id == 0)
		diff->failed = true;
	if (diff->bytes.failed)
		diff->failed = true;
	return id;
}

uint32_t diff_name(struct diff *diff, const char *name)
{
	uint32_t id = diff_id(diff, name, strlen(name));
	uint32_t fold = id ? names_fold(&diff->names, id) : 0;

	if (id && !fold)
		diff->failed = true;
	return fold;
}

/* ---- variables ---- */

#define TYPE_TEXT (LIMIT_NAME + 64)

/* As it is declared: ARRAY[1..3] OF STRING[20]. */
static const char *type_text(const struct project *project,
			     const struct var *var, char room[TYPE_TEXT])
{
	const char *word = var->type == IEC_NONE ?
		words_row(&project->words, var->fb)->word :
		iec_type_row(var->type)->word;
	char bounds[48] = "", capacity[16] = "";

	if (var->array.count)
		snprintf(bounds, sizeof(bounds), "ARRAY[%ld..%lld] OF ",
			 (long)var->array.low,
			 (long long)var->array.low + var->array.count - 1);
	if (var->type == IEC_STRING && var->capacity != IEC_STRING_DEFAULT)
		snprintf(capacity, sizeof(capacity), "[%u]", var->capacity);
	snprintf(room, TYPE_TEXT, "%s%.255s%s", bounds, word, capacity);
	return room;
}

/* "" of a plain VAR; VAR_GLOBAL says the same. */
static const char *flags_text(uint16_t flags)
{
	static const char *const text[] = { "", "RETAIN", "CONSTANT",
					    "RETAIN CONSTANT" };
	static const uint8_t kinds = VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP;

	if (flags & kinds && !(flags & VAR_RETAIN))
		return vars_head(flags & kinds);
	if (flags & VAR_INPUT)
		return "VAR_INPUT RETAIN";
	if (flags & VAR_OUTPUT)
		return "VAR_OUTPUT RETAIN";
	return text[flags & (VAR_RETAIN | VAR_CONSTANT)];
}

static const char *init_text(const struct project *project,
			     const struct var *var)
{
	return var->has_init ? project_text(project, var->init_text) : "";
}

static void compare_var(struct diff *diff, struct difference what,
			const struct var_table *a, int i,
			const struct var_table *b, int j)
{
	const struct var *x = &a->var[i], *y = &b->var[j];
	char old[TYPE_TEXT], new[TYPE_TEXT];

	diff_texts(diff, what, "name", project_text(diff->a, x->name),
		   project_text(diff->b, y->name));
	diff_texts(diff, what, "type", type_text(diff->a, x, old),
		   type_text(diff->b, y, new));
	diff_texts(diff, what, "address", project_text(diff->a, x->at_text),
		   project_text(diff->b, y->at_text));
	diff_texts(diff, what, "initial value", init_text(diff->a, x),
		   init_text(diff->b, y));
	diff_texts(diff, what, "block", flags_text(vars_flags(a, i)),
		   flags_text(vars_flags(b, j)));
	diff_texts(diff, what, "comment", project_text(diff->a, x->comment),
		   project_text(diff->b, y->comment));
}

/* Folded names of a table, and where a name stands in it. */
static uint32_t *var_names(struct diff *diff, const struct project *project,
			   const struct var_table *table)
{
	const int count = vars_declared(table);
	uint32_t *name = arena_alloc(&diff->arena, (size_t)(count + 1) * sizeof(*name));

	if (!name)
		diff->failed = true;
	for (int i = 0; name && i < count; i++)
		name[i] = diff_name(diff, project_text(project,
						       table->var[i].name));
	return name;
}

static int *var_index(struct diff *diff, const uint32_t *name, int count)
{
	int *index = arena_alloc(&diff->arena, (size_t)(diff->names.count + 1) *
					       sizeof(int));

	if (!index)
		diff->failed = true;
	for (int i = count - 1; index && i >= 0; i--)
		index[name[i]] = i + 1;
	return index;
}

static void compare_vars(struct diff *diff, const char *pou,
			 const struct var_table *a, const struct var_table *b)
{
	struct difference what = { .pou = pou, .kind = "variable" };
	uint32_t *name_a = var_names(diff, diff->a, a);
	uint32_t *name_b = var_names(diff, diff->b, b);

	if (diff->failed)
		return;
	const int a_count = vars_declared(a), b_count = vars_declared(b);
	int *in_a = var_index(diff, name_a, a_count);
	int *in_b = var_index(diff, name_b, b_count);
	for (int i = 0; !diff->failed && i < a_count; i++) {
		what.subject = project_text(diff->a, a->var[i].name);
		what.change = in_b[name_a[i]] ? NULL : "removed";
		if (what.change)
			diff_say(diff, what);
		else
			compare_var(diff, what, a, i, b, in_b[name_a[i]] - 1);
	}
	what.change = "added";
	for (int j = 0; !diff->failed && j < b_count; j++)
		if (!in_a[name_b[j]]) {
			what.subject = project_text(diff->b, b->var[j].name);
			diff_say(diff, what);
		}
}

/* ---- POUs ---- */

static const struct pou *pou_named(const struct project *project,
				   const char *name)
{
	int i = project_find_pou(project, name, strlen(name));

	return i < 0 ? NULL : &project->pou[i];
}

static const char *language(const struct pou *pou)
{
	return pou_language_word(pou->language);
}

static const char *evolution(const struct pou *pou)
{
	return sfc_evolution_words(pou->sfc->evolution);
}

static void compare_pou(struct diff *diff, const struct pou *a,
			const struct pou *b)
{
	const char *name = project_text(diff->a, a->name);
	struct difference what = { .pou = name };

	diff_texts(diff, what, "name", name, project_text(diff->b, b->name));
	diff_texts(diff, what, "kind", pou_word(a->kind), pou_word(b->kind));
	diff_texts(diff, what, "comment", project_text(diff->a, a->comment),
		   project_text(diff->b, b->comment));
	diff_texts(diff, what, "closing comment",
		   project_text(diff->a, a->tail),
		   project_text(diff->b, b->tail));
	compare_vars(diff, name, &a->vars, &b->vars);
	if (a->sfc && b->sfc)
		diff_texts(diff, what, "evolution", evolution(a), evolution(b));
	if (a->language != b->language)
		diff_texts(diff, what, "language", language(a), language(b));
	else if (a->language == LANGUAGE_LD)
		diff_rungs(diff, a, b);
	else
		diff_il(diff, a, b);
}

static const char *kind_text(const struct pou *pou)
{
	return pou->kind == POU_PROGRAM ? "program" :
	       pou->kind == POU_FUNCTION ? "function" :
	       pou->kind == POU_BLOCK ? "function block" : "subroutine";
}

static void compare_pous(struct diff *diff)
{
	struct difference what = { 0 };

	for (int i = 0; i < diff->a->pou_count; i++) {
		const struct pou *a = &diff->a->pou[i];
		const struct pou *b;

		what.subject = project_text(diff->a, a->name);
		what.kind = kind_text(a);
		what.change = "removed";
		b = pou_named(diff->b, what.subject);
		if (b)
			compare_pou(diff, a, b);
		else
			diff_say(diff, what);
	}
	for (int j = 0; j < diff->b->pou_count; j++) {
		what.subject = project_text(diff->b, diff->b->pou[j].name);
		what.kind = kind_text(&diff->b->pou[j]);
		what.change = "added";
		if (!pou_named(diff->a, what.subject))
			diff_say(diff, what);
	}
}

/* ---- structures ---- */

static const struct structure *structure_named(const struct project *project,
					       const char *name)
{
	for (int i = 0; i < project->structure_count; i++)
		if (strcasecmp(project_text(project, project->structure[i].name),
			       name) == 0)
			return &project->structure[i];
	return NULL;
}

static void compare_structures(struct diff *diff)
{
	struct difference what = { .kind = "type" };

	for (int i = 0; i < diff->a->structure_count; i++) {
		const struct structure *a = &diff->a->structure[i], *b;

		what.subject = project_text(diff->a, a->name);
		what.change = "removed";
		b = structure_named(diff->b, what.subject);
		if (b)
			compare_vars(diff, what.subject, &a->vars, &b->vars);
		else
			diff_say(diff, what);
	}
	for (int j = 0; j < diff->b->structure_count; j++) {
		what.subject = project_text(diff->b, diff->b->structure[j].name);
		what.change = "added";
		if (!structure_named(diff->a, what.subject))
			diff_say(diff, what);
	}
}

/* ---- what the engine only keeps ---- */

/* Text of the section of @kind after part @*at; NULL: there is none. */
static const char *next_part(const struct project *project, enum part_kind kind,
			     int *at)
{
	while (*at < project->part_count) {
		const struct part *part = &project->part[(*at)++];

		if (part->kind == kind && !part->included)
			return project_text(project, part->text);
	}
	return NULL;
}

static void compare_parts(struct diff *diff, enum part_kind kind,
			  const char *word)
{
	struct difference what = { .kind = word };
	int at_a = 0, at_b = 0;

	for (;;) {
		const char *a = next_part(diff->a, kind, &at_a);
		const char *b = next_part(diff->b, kind, &at_b);

		if (!a && !b)
			return;
		if (a && b && strcmp(a, b) == 0)
			continue;
		what.change = !a ? "added" : !b ? "removed" : "changed";
		what.subject = kind == PART_VIEW ? NULL : b ? b : a;
		diff_say(diff, what);
	}
}

static void compare_texts(struct diff *diff)
{
	size_t a_len, b_len;
	char *a = text_write(diff->a, &a_len);
	char *b = text_write(diff->b, &b_len);

	if (!a || !b)
		diff->failed = true;
	else if (a_len != b_len || memcmp(a, b, a_len) != 0)
		diff_say(diff, (struct difference){
			.kind = "order, layout or comments",
			.change = "changed",
		});
	free(a);
	free(b);
}

static void compare(struct diff *diff)
{
	struct difference what = { .kind = "project" };
	const struct project *a = diff->a, *b = diff->b;

	diff_texts(diff, what, "title", project_text(a, a->title),
		   project_text(b, b->title));
	diff_texts(diff, what, "opening comment", project_text(a, a->head),
		   project_text(b, b->head));
	diff_texts(diff, what, "closing comment", project_text(a, a->tail),
		   project_text(b, b->tail));
	compare_parts(diff, PART_INCLUDE, "INCLUDE");
	compare_parts(diff, PART_USES, "USES");
	diff_config(diff);
	compare_structures(diff);
	compare_vars(diff, NULL, &a->globals, &b->globals);
	compare_pous(diff);
	compare_parts(diff, PART_VIEW, "VIEW section");
	if (diff->count == 0 && !diff->failed)
		compare_texts(diff);
}

struct diff *diff_open(const struct project *a, const struct project *b,
		       const struct sink *sink)
{
	struct diff *diff = calloc(1, sizeof(*diff));

	if (!diff)
		return NULL;
	diff->a = a;
	diff->b = b;
	diff->sink = sink;
	arena_init(&diff->arena);
	names_init(&diff->names, &diff->arena);
	sink_memory_init(&diff->bytes);
	return diff;
}

bool diff_close(struct diff *diff)
{
	bool good = !diff->failed && !diff->arena.failed;

	sink_memory_free(&diff->bytes);
	arena_free(&diff->arena);
	free(diff);
	return good;
}

int compare_projects(const struct project *a, const struct project *b, bool json,
	      const struct sink *sink)
{
	struct diff *diff = diff_open(a, b, sink);

	if (!diff)
		return -1;
	diff->json = json;
	sink_text(sink, json ? "[" : "");
	compare(diff);
	sink_text(sink, json ? (diff->count ? "\n]\n" : "]\n") : "");

	int count = diff->count;
	return diff_close(diff) ? count : -1;
}

int compare_besides(const struct project *a, const struct project *b, const char *pou,
		      const struct sink *sink)
{
	struct diff *diff = diff_open(a, b, sink);

	if (!diff)
		return -1;
	diff->besides = true;
	diff->pou = pou;
	compare(diff);

	int said = diff->said;
	return diff_close(diff) ? said : -1;
}
