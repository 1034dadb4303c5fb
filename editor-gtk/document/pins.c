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

/* The pin that power goes to or comes from, with variables @a and @b exchanged. -1: none. */
static int power_pin(const struct pou *pou, uint16_t kind, int a, int b)
{
	for (int i = 0; i < vars_declared(&pou->vars); i++) {
		const int at = i == a ? b : i == b ? a : i;

		if (pins_kind(pou, at) == kind && is_plain_bool(&pou->vars.var[at]))
			return at;
	}
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

/* Why two pins cannot change places; NULL: they can. */
static char *why_not(LadderDocument *document, int pou, int a, int b)
{
	const struct project *project = ladder_document_project(document);
	const struct pou *of = &project->pou[pou];
	const uint16_t kind = pins_kind(of, a);
	char *why = kind ? why_fixed(document, pou) : NULL;

	if (why || !kind)
		return why;
	if (of->kind == POU_BLOCK && kind != VAR_IN_OUT &&
	    power_pin(of, kind, a, b) != power_pin(of, kind, -1, -1) &&
	    has_boxes(project, of->word))
		return g_strdup_printf(_("The power of the row is connected to “%s” where the "
			"block is used: it must stay the first of type BOOL"),
			project_text(project, of->vars.var[power_pin(of, kind, -1, -1)].name));
	return NULL;
}

/* ---- moving ---- */

struct two_spans {
	int pou, index[2];
	struct text_span span[2];
};

static void take_pin(void *context, const struct text_span *span)
{
	struct two_spans *two = context;

	for (int i = 0; i < 2; i++)
		if (span->part == TEXT_VAR && span->pou == two->pou && span->structure < 0 &&
		    span->number == two->index[i])
			two->span[i] = *span;
}

/* The next (@by 1) or previous (-1) variable with the same qualifiers; -1: there is none. */
static int beside(const struct pou *of, int index, int by)
{
	const struct var_table *vars = &of->vars;

	for (int i = index + by; i >= 0 && i < vars_declared(vars); i += by)
		if (vars_flags(vars, i) == vars_flags(vars, index))
			return i;
	return -1;
}

/* Two variables change places; what is written between them stays. */
static char *exchange(LadderDocument *document, int pou, int a, int b)
{
	struct two_spans two = { .pou = pou, .index = { MIN(a, b), MAX(a, b) } };
	gsize len;
	char *all = ladder_document_outline(document, &len, take_pin, &two);
	const struct text_span *first = &two.span[0], *second = &two.span[1];
	const gsize between = second->at - first->at - first->len;
	char *text = g_strdup_printf("%.*s%.*s%.*s", (int)second->len, all + second->at,
				     (int)between, all + first->at + first->len,
				     (int)first->len, all + first->at);
	char *why = ladder_document_replace_step(document, first->at,
		first->len + between + second->len, text, _("Move pin"));

	g_free(text);
	g_free(all);
	return why;
}

char *pin_move(LadderDocument *document, int pou, int index, int by)
{
	const struct pou *of = &ladder_document_project(document)->pou[pou];
	const int other = beside(of, index, by);
	char *why;

	if (of->included)
		return g_strdup(_("It is declared in another file"));
	if (other < 0)
		return g_strdup(by < 0 ? _("It is the first one already") :
					 _("It is the last one already"));
	why = why_not(document, pou, index, other);
	return why ? why : exchange(document, pou, index, other);
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
		       power_pin(of, kind, -1, -1) : -1;

	return g_strdup(at < 0 ? "" : project_text(project, of->vars.var[at].name));
}

/* Refuses a change after which power goes to another pin. */
static char *why_power(const char *was, const char *is)
{
	if (strcmp(was, is) == 0)
		return NULL;
	return *was ? g_strdup_printf(_("The power of the row is connected to “%s” where the block "
			"is used: it must stay so"), was) :
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

/* -1, 1: it must go up or down among those of its kind to stand before @before, NULL: at the end;
 * 0: it stands there. */
static int way_to(LadderDocument *document, int pou, const char *name, const char *before)
{
	const struct var_table *vars = &ladder_document_project(document)->pou[pou].vars;
	const int at = index_named(document, pou, name), to = index_named(document, pou, before);
	const uint16_t kind = vars_flags(vars, at) & SYMBOL_KINDS;
	int next = at + 1;

	while (next < vars_declared(vars) && (vars_flags(vars, next) & SYMBOL_KINDS) != kind)
		next++;
	if (to < 0)
		return next < vars_declared(vars);
	return to < at ? -1 : to == next || to == at ? 0 : 1;
}

char *pin_put(LadderDocument *document, int pou, int index, uint16_t kind, int before)
{
	const struct project *project = ladder_document_project(document);
	const struct var_table *vars = &project->pou[pou].vars;
	char *name = g_strdup(project_text(project, vars->var[index].name));
	char *mark = before < 0 ? NULL : g_strdup(project_text(project, vars->var[before].name));
	char *why = NULL;
	int way, first = 0;

	ladder_document_begin(document, _("Move pin"), NULL);
	if ((vars_flags(vars, index) & SYMBOL_KINDS) != kind)
		why = pin_set_kind(document, pou, index, kind);
	/* A neighbour of another block may be passed at once: it never turns back. */
	while (!why && (way = way_to(document, pou, name, mark)) != 0 && way != -first) {
		why = pin_move(document, pou, index_named(document, pou, name), way);
		first = way;
	}
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
