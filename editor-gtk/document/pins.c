/* SPDX-License-Identifier: MIT
 *
 * pins - the interface of a function or function block; see pins.h.
 */
#include "editor-gtk/document/pins.h"

#include "editor-gtk/document/symbols.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <string.h>

#define PINS (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT)

uint16_t pins_kind(const struct pou *pou, int index)
{
	return index >= 0 && index < vars_declared(&pou->vars) ?
	       vars_flags(&pou->vars, index) & PINS : 0;
}

int pins_count(const struct pou *pou, uint16_t kind)
{
	int count = 0;

	for (int i = 0; i < vars_declared(&pou->vars); i++)
		count += pins_kind(pou, i) == kind;
	return count;
}

/* ---- callers that depend on the order ---- */

static bool is_name(const struct token *token, const char *name)
{
	return token->kind == TOKEN_NAME && name_is(name, token->text, token->len);
}

/* From "(" on: operands, and none of them with the name of a pin? */
static bool is_positional(struct lex *lex)
{
	bool any = false, named = false;

	for (int depth = 0; lex_next(lex) != TOKEN_END;) {
		depth += lex_is(lex, "(") - lex_is(lex, ")");
		if (depth < 0)
			break;
		any = true;
		named = named || lex_is(lex, ":=") || lex_is(lex, "=>");
	}
	return any && !named;
}

static void skip_index(struct lex *lex)
{
	while (!lex_is(lex, "]") && lex->token.kind != TOKEN_END)
		lex_next(lex);
	lex_next(lex);
}

/* Is the function or instance @name called in a text with operands by position? In a list the
 * first input of a function without parentheses is the result. */
static bool calls_by_position(const char *text, const char *name, bool list, bool function)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	for (lex_next(&lex); lex.token.kind != TOKEN_END;) {
		const bool here = is_name(&lex.token, name);

		lex_next(&lex);
		if (!here)
			continue;
		if (lex_is(&lex, "["))
			skip_index(&lex);
		if (lex_is(&lex, "(") ? is_positional(&lex) : list && function)
			return true;
	}
	return false;
}

/* Does POU @caller call it so, by its own name or that of an instance in @vars? */
static bool is_called(const struct project *project, int pou, const char *text, bool list,
		      const struct var_table *vars)
{
	const struct pou *of = &project->pou[pou];

	if (of->kind == POU_FUNCTION)
		return calls_by_position(text, project_text(project, of->name), list, true);
	for (int i = 0; i < vars->count; i++)
		if (vars->var[i].type == IEC_NONE && vars->var[i].fb == of->word &&
		    calls_by_position(text, project_text(project, vars->var[i].name), list,
				      false))
			return true;
	return false;
}

/* The first POU that gives operands by position; -1: none does. */
static int caller_by_position(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);

	for (int n = 0; n < project->pou_count; n++) {
		const struct pou *caller = &project->pou[n];
		char *text = n == pou ? NULL : ladder_document_list(document, n);
		const bool list = caller->language != LANGUAGE_LD;
		const bool found = text &&
			(is_called(project, pou, text, list, &caller->vars) ||
			 is_called(project, pou, text, list, &project->globals));

		g_free(text);
		if (found)
			return n;
	}
	return -1;
}

static bool has_boxes(const struct project *project, enum word word)
{
	for (int n = 0; n < project->pou_count; n++)
		for (int i = 0; i < project->pou[n].rung_count; i++) {
			const struct rung *rung = project->pou[n].rung[i];

			for (int k = 0; k < rung->rows * rung->cols; k++)
				if (rung->cell[k].word == word)
					return true;
		}
	return false;
}

static bool is_plain_bool(const struct var *var)
{
	return var->type == IEC_BOOL && !var->array.count;
}

/* The pin that power goes to or comes from; -1: none. */
static int power_pin(const struct pou *pou, uint16_t kind)
{
	for (int i = 0; i < vars_declared(&pou->vars); i++)
		if (pins_kind(pou, i) == kind && is_plain_bool(&pou->vars.var[i]))
			return i;
	return -1;
}

/* Why no pin of a POU can move: a caller gives operands by position. NULL: they can. */
static char *why_fixed(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	const int caller = caller_by_position(document, pou);

	return caller < 0 ? NULL : g_strdup_printf(_("“%s” gives operands by position: they "
		"would go to other pins. Name the pins there first."),
		project_text(project, project->pou[caller].name));
}

/* ---- kinds ---- */

int pin_calls(LadderDocument *document, int pou, int index)
{
	struct project *project = ladder_document_project(document);
	struct xref xref = { 0 };
	int count = 0;

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];

		count += use->target.what == XREF_VARIABLE && use->target.table == pou + 1 &&
			 use->target.index == index && use->kind != XREF_DECLARED &&
			 use->pou != pou;
	}
	xref_free(&xref);
	return count;
}

/* The pin of a side that the power of a row is connected to; "": none. Caller frees. */
static char *power_name(const struct project *project, int pou, uint16_t kind)
{
	const struct pou *of = &project->pou[pou];
	const int at = of->kind == POU_BLOCK && has_boxes(project, of->word) ?
		       power_pin(of, kind) : -1;

	return g_strdup(at < 0 ? "" : project_text(project, of->vars.var[at].name));
}

/* Refuses a change after which power goes to another pin. */
static char *why_power(const char *was, const char *is)
{
	if (strcmp(was, is) == 0)
		return NULL;
	return *was ? g_strdup_printf(_("Where the block is used, the power of its row is connected to “%s”. Delete its boxes "
			"first, or keep this pin as it is"), was) :
		g_strdup_printf(_("The power of the row would be connected to “%s” where the block "
			"is used"), is);
}

/* Changes it; @why: also if a side then has another pin for the power, which undoes it. */
static void set_kind(LadderDocument *document, int pou, int index, uint16_t kind, char **why)
{
	static const uint16_t sides[] = { VAR_INPUT, VAR_OUTPUT };
	char *was[G_N_ELEMENTS(sides)];

	for (gsize i = 0; i < G_N_ELEMENTS(sides); i++)
		was[i] = power_name(ladder_document_project(document), pou, sides[i]);
	ladder_document_begin(document, _("Change kind"), NULL);
	symbol_set_kind(document, pou + 1, index, kind, why);
	for (gsize i = 0; i < G_N_ELEMENTS(sides); i++) {
		char *is = power_name(ladder_document_project(document), pou, sides[i]);

		if (!*why)
			*why = why_power(was[i], is);
		g_free(is);
		g_free(was[i]);
	}
	if (*why)
		ladder_document_cancel(document);
	else
		ladder_document_end(document);
}

char *pin_set_kind(LadderDocument *document, int pou, int index, uint16_t kind)
{
	const struct pou *of = &ladder_document_project(document)->pou[pou];
	char *why = of->included ? g_strdup(_("It is declared in another file")) : NULL;

	if (!why && (pins_kind(of, index) || kind & PINS))
		why = why_fixed(document, pou);
	if (!why)
		set_kind(document, pou, index, kind, &why);
	return why;
}

static int index_named(LadderDocument *document, int pou, const char *name)
{
	const struct project *project = ladder_document_project(document);
	const struct pou *of = &project->pou[pou];

	for (int i = 0; name && i < vars_declared(&of->vars); i++)
		if (name_equal(project_text(project, of->vars.var[i].name), name))
			return i;
	return -1;
}

/* ---- moving ---- */

/* The next (@by 1) or previous (-1) variable of a kind but @but; -1: none. */
static int beside(const struct var_table *vars, uint16_t kind, int from, int by, int but)
{
	for (int i = from + by; i >= 0 && i < vars_declared(vars); i += by)
		if (i != but && !(vars_flags(vars, i) & VAR_RESULT) &&
		    (vars_flags(vars, i) & SYMBOL_KINDS) == kind)
			return i;
	return -1;
}

/* A moved variable and those that it will stand before and behind; -1: none. */
enum { MOVED, NEXT, PREVIOUS, INVOLVED };

struct way {
	const struct var_table *vars;
	int pou, index[INVOLVED], block[INVOLVED];
	struct text_span var[INVOLVED], around[INVOLVED]; /* and their blocks      */
};

static void take_spans(void *context, const struct text_span *span)
{
	struct way *way = context;

	if (span->pou != way->pou || span->structure >= 0)
		return;
	for (int i = 0; i < INVOLVED; i++) {
		if (span->part == TEXT_VAR && span->number == way->index[i])
			way->var[i] = *span;
		if (span->part == TEXT_BLOCK && span->number == way->block[i])
			way->around[i] = *span;
	}
}

static bool is_like(const struct way *way, int other)
{
	return way->index[other] >= 0 && vars_flags(way->vars, way->index[other]) ==
					 vars_flags(way->vars, way->index[MOVED]);
}

static bool is_inside(const struct way *way)
{
	return way->index[NEXT] >= 0 && way->index[PREVIOUS] >= 0 &&
	       symbol_block(way->vars, way->index[NEXT]) ==
	       symbol_block(way->vars, way->index[PREVIOUS]);
}

/* Finds the place before @before. A block with other qualifiers, such as RETAIN, is not divided:
 * it is passed. False: the variable stands there. */
static bool find_way(struct way *way, int index, int before)
{
	const uint16_t kind = vars_flags(way->vars, index) & SYMBOL_KINDS;
	const int end = vars_declared(way->vars);
	const bool down = before < 0 || before > index;

	if (beside(way->vars, kind, index, 1, -1) == before || index == before)
		return false;
	way->index[MOVED] = index;
	way->index[NEXT] = before;
	way->index[PREVIOUS] = beside(way->vars, kind, before < 0 ? end : before, -1, index);
	while (is_inside(way) && !is_like(way, NEXT) && !is_like(way, PREVIOUS)) {
		const int by = down ? 1 : -1;
		const int from = way->index[down ? NEXT : PREVIOUS];

		way->index[down ? PREVIOUS : NEXT] = from;
		way->index[down ? NEXT : PREVIOUS] = beside(way->vars, kind, from, by, index);
	}
	for (int i = 0; i < INVOLVED; i++)
		way->block[i] = way->index[i] < 0 ? -1 : symbol_block(way->vars, way->index[i]);
	return true;
}

/* The moved variable in a block of its own: that around it, if it is alone there. Caller frees. */
static char *own_block(const struct way *way, const char *all, bool alone)
{
	const struct text_span *var = &way->var[MOVED], *around = &way->around[MOVED];
	char *head = symbol_text_block(vars_flags(way->vars, way->index[MOVED]));
	char *text = alone ? g_strndup(all + around->at, around->len) :
		     g_strdup_printf("%s%.*sEND_VAR\n", head, (int)var->len, all + var->at);

	g_free(head);
	return text;
}

/* What is inserted, and where. Caller frees. */
static char *inserted(const struct way *way, const char *all, bool alone, gsize *at)
{
	if (is_like(way, NEXT) || is_like(way, PREVIOUS)) {
		*at = is_like(way, NEXT) ? way->var[NEXT].at :
		      way->var[PREVIOUS].at + way->var[PREVIOUS].len;
		return g_strndup(all + way->var[MOVED].at, way->var[MOVED].len);
	}
	*at = way->index[NEXT] >= 0 ? way->around[NEXT].at :
	      way->around[PREVIOUS].at + way->around[PREVIOUS].len;
	return own_block(way, all, alone);
}

/* Whether nothing else is in its block, which goes with it: comments there do not, if it goes to
 * another block. */
static bool is_alone(const struct way *way)
{
	char *head = symbol_text_block(vars_flags(way->vars, way->index[MOVED]));
	const gsize plain = strlen(head) + way->var[MOVED].len + strlen("END_VAR\n");
	const bool only = way->vars->block[way->block[MOVED]].count == 1;

	g_free(head);
	return only && (way->around[MOVED].len == plain ||
			(!is_like(way, NEXT) && !is_like(way, PREVIOUS)));
}

static char *go(LadderDocument *document, const struct way *way, const char *all)
{
	const bool alone = is_alone(way);
	const struct text_span *cut = alone ? &way->around[MOVED] : &way->var[MOVED];
	gsize at;
	char *new = inserted(way, all, alone, &at), *text, *why;

	if (at <= cut->at)
		text = g_strdup_printf("%s%.*s", new, (int)(cut->at - at), all + at);
	else
		text = g_strdup_printf("%.*s%s", (int)(at - cut->at - cut->len),
				       all + cut->at + cut->len, new);
	why = ladder_document_replace_step(document, MIN(at, cut->at), at <= cut->at ?
		cut->at + cut->len - at : at - cut->at, text, _("Move pin"));
	g_free(text);
	g_free(new);
	return why;
}

static char *move(LadderDocument *document, int pou, int index, int before)
{
	struct way way = { .pou = pou,
			   .vars = &ladder_document_project(document)->pou[pou].vars };
	char *all, *why = pins_kind(&ladder_document_project(document)->pou[pou], index) ?
			  why_fixed(document, pou) : NULL;
	gsize len;

	if (why || !find_way(&way, index, before))
		return why;
	all = ladder_document_outline(document, &len, take_spans, &way);
	why = go(document, &way, all);
	g_free(all);
	return why;
}

/* Moves it; it is refused if the power then goes to another pin. */
static char *move_with_power(LadderDocument *document, int pou, int index, int before)
{
	const uint16_t kind = pins_kind(&ladder_document_project(document)->pou[pou], index);
	char *was = power_name(ladder_document_project(document), pou, kind);
	char *why = move(document, pou, index, before);
	char *is = power_name(ladder_document_project(document), pou, kind);

	if (!why && kind && kind != VAR_IN_OUT && strcmp(was, is) != 0)
		why = g_strdup_printf(_("The power of the row is connected to “%s” where the "
			"block is used: it must stay the first of type BOOL"), was);
	g_free(is);
	g_free(was);
	return why;
}

char *pin_put(LadderDocument *document, int pou, int index, uint16_t kind, int before)
{
	const struct project *project = ladder_document_project(document);
	const struct pou *of = &project->pou[pou];
	char *name = g_strdup(project_text(project, of->vars.var[index].name));
	char *mark = before < 0 ? NULL : g_strdup(project_text(project, of->vars.var[before].name));
	char *why = of->included ? g_strdup(_("It is declared in another file")) : NULL;

	ladder_document_begin(document, _("Move pin"), NULL);
	if (!why && (vars_flags(&of->vars, index) & SYMBOL_KINDS) != kind)
		why = pin_set_kind(document, pou, index, kind);
	if (!why)
		why = move_with_power(document, pou, index_named(document, pou, name),
				      index_named(document, pou, mark));
	if (why)
		ladder_document_cancel(document);
	else
		ladder_document_end(document);
	g_free(mark);
	g_free(name);
	return why;
}

char *pins_set_result(LadderDocument *document, int pou, const char *type)
{
	struct text_span span;
	char *all, *why, *heading;
	const char *colon, *end;

	if (ladder_document_project(document)->pou[pou].included)
		return g_strdup(_("It is declared in another file"));
	all = ladder_document_pou(document, pou, &span);
	heading = g_strndup(all + span.at, strcspn(all + span.at, "\n"));
	colon = strstr(heading, " : ");
	end = strrchr(heading, ' ');
	why = !colon || end < colon + 3 ? g_strdup(_("It cannot be read")) :
		ladder_document_replace_step(document, span.at + (gsize)(colon + 3 - heading),
					     (gsize)(end - colon - 3), type, _("Change type"));
	g_free(heading);
	g_free(all);
	return why;
}
