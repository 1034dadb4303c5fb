/* SPDX-License-Identifier: MIT
 *
 * st_why - why a condition is TRUE or FALSE; see st_why.h.
 */
#include "editor-gtk/sim/st_why.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_named.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/st_formula.h"

#include "engine/base/lex.h"
#include "engine/ladder.h"
#include "engine/model/named.h"
#include "engine/trial/formula.h"
#include "engine/trial/why.h"

#include <string.h>

struct asked {
	LadderSim *sim;
	const char *pou;
	int network;              /* whose wires are names; -1: none            */
	const struct image *image;
	struct project *project;
};

/* ---- the condition ---- */

static bool ends(const struct lex *lex)
{
	return lex->token.kind == TOKEN_END || lex_is(lex, ";") || lex_is(lex, "THEN") ||
	       lex_is(lex, "DO") || lex_is(lex, "END_REPEAT");
}

/* The tokens of the condition that begins in the line, as struct token; NULL: none does. */
static GArray *condition_at(const char *text, int line)
{
	GArray *tokens = g_array_new(FALSE, FALSE, sizeof(struct token));
	struct lex lex;
	bool begun;

	for (; line > 0 && text; line--) {
		text = strchr(text, '\n');
		text = text ? text + 1 : NULL;
	}
	lex_init(&lex, text ? text : "", text ? strlen(text) : 0);
	lex_next(&lex);
	begun = lex_is(&lex, "IF") || lex_is(&lex, "ELSIF") || lex_is(&lex, "WHILE") ||
		lex_is(&lex, "UNTIL");
	while (!begun && !ends(&lex) && lex.token.line == 1) {
		begun = lex_is(&lex, ":=");
		if (!begun)
			lex_next(&lex);
	}
	while (begun && lex_next(&lex) != TOKEN_END && !ends(&lex))
		g_array_append_val(tokens, lex.token);
	if (tokens->len)
		return tokens;
	g_array_unref(tokens);
	return NULL;
}

/* ---- a part of it ---- */

/* A name as the whole program knows it; *@at: where it is. Caller frees. */
static char *whole_name(const struct asked *asked, const struct token *token, struct location *at)
{
	char *name = g_strndup(token->text, token->len);
	char *local = asked->network < 0 ? g_strdup_printf("%s.%s", asked->pou, name) :
		      g_strdup_printf("%s.%s.N%d", asked->pou, name, asked->network + 1);

	*at = live_value_find(asked->image, local);
	if (at->type == IEC_NONE && asked->network >= 0) { /* it is no wire */
		g_free(local);
		local = g_strdup_printf("%s.%s", asked->pou, name);
		*at = live_value_find(asked->image, local);
	}
	if (at->type != IEC_NONE) {
		g_free(name);
		return local;
	}
	g_free(local);
	*at = live_value_find(asked->image, name);
	return name;
}

/* @source: the part as it is written, @formula: with whole names and numbers, @values: "Level = 0". */
static void take_token(const struct asked *asked, const struct token *token, GString *formula,
		       GString *values)
{
	struct location at = { .type = IEC_NONE };
	char *number, *name, *word, value[48];

	if (token->kind != TOKEN_NAME && !memchr(token->text, '#', token->len)) {
		g_string_append_printf(formula, " %.*s", (int)token->len, token->text);
		return;
	}
	number = st_formula_number(asked->project, token);
	name = number ? number : whole_name(asked, token, &at);
	g_string_append_printf(formula, " %s", name);
	word = g_strndup(token->text, token->len);
	if (at.type != IEC_NONE && at.type != IEC_BOOL) {
		live_named_print(live_named_find(asked->sim, false, "", name), at.type,
				 image_get(asked->image, at), value, sizeof(value));
		g_string_append_printf(values, "%s%s = %s", values->len ? ", " : "", word, value);
	}
	g_free(word);
	g_free(name);
}

/* 0, 1; -1: it has no value. */
static int value_of(const struct asked *asked, const char *text)
{
	struct diag_list *ignored = g_new(struct diag_list, 1);
	struct expr *expr = g_new(struct expr, 1);
	struct formula *formula = NULL;
	union iec_value value = { 0 };
	struct arena arena;
	int known = -1;

	arena_init(&arena);
	diag_init(ignored);
	if (expr_parse_text(text, strlen(text), expr, ignored, (struct diag){ .id = DIAG_COUNT }))
		formula = formula_new(asked->image, NULL, (struct formula_projects){ asked->project, NULL }, expr, &arena, text, ignored,
				      (struct diag){ .id = DIAG_COUNT });
	if (formula && formula_kind(formula) == KIND_BOOL &&
	    formula_value(formula, asked->image, &value))
		known = value.i != 0;
	arena_free(&arena);
	g_free(expr);
	g_free(ignored);
	return known;
}

/* Says the part of tokens [@from, @to): "Level > 5 is not true (Level = 3)". Returns its value. */
static int say_part(const struct asked *asked, GArray *tokens, guint from, guint to, GString *out)
{
	GString *formula = g_string_new(NULL), *values = g_string_new(NULL);
	const struct token *first = &g_array_index(tokens, struct token, from);
	const struct token *last = &g_array_index(tokens, struct token, to - 1);
	char *source = g_strndup(first->text, (gsize)(last->text + last->len - first->text));
	const bool name = to == from + 1;
	const char *said;
	int value;

	for (guint i = from; i < to; i++)
		take_token(asked, &g_array_index(tokens, struct token, i), formula, values);
	value = value_of(asked, formula->str);
	if (value >= 0) {
		said = _(why_text(name ? WHY_CONTACT : WHY_COMPARE, value != 0));
		g_string_append_len(out, said, strstr(said, "%s") - said);
		g_string_append(out, source);
		g_string_append(out, strstr(said, "%s") + 2);
		if (values->len)
			g_string_append_printf(out, " (%s)", values->str);
	}
	g_free(source);
	g_string_free(formula, TRUE);
	g_string_free(values, TRUE);
	return value;
}

/* ---- all of it ---- */

/* The end of the part at @from: the next @word outside of parentheses, or the end. */
static guint part_end(GArray *tokens, guint from, guint to, const char *word, const char *other)
{
	int open = 0;

	for (guint i = from; i < to; i++) {
		const struct token *token = &g_array_index(tokens, struct token, i);
		struct lex lex = { .token = *token };

		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		if (open == 0 && (lex_is(&lex, word) || (other && lex_is(&lex, other))))
			return i;
	}
	return to;
}

/* Parts with XOR between them: each of them decides, whatever its value is. */
static int say_xor(const struct asked *asked, GArray *tokens, guint from, guint to, GString *right,
		   GString *wrong)
{
	GString *parts = g_string_new(NULL), *into;
	int all = 0;

	while (from < to) {
		const guint end = part_end(tokens, from, to, "XOR", NULL);
		GString *part = g_string_new(NULL);
		const int value = end > from ? say_part(asked, tokens, from, end, part) : -1;

		if (value >= 0)
			g_string_append_printf(parts, "%s%s", parts->len ? _("; and ") : "", part->str);
		all = value < 0 || all < 0 ? -1 : all ^ value;
		g_string_free(part, TRUE);
		from = end + 1;
	}
	into = all ? right : wrong;
	g_string_append(into, parts->str);
	g_string_free(parts, TRUE);
	return all;
}

/* One way between two ORs: the parts that are @wanted. Returns its value; -1: not known. */
static int say_way(const struct asked *asked, GArray *tokens, guint from, guint to, GString *right,
		   GString *wrong)
{
	int all = 1;

	if (part_end(tokens, from, to, "XOR", NULL) < to)
		return say_xor(asked, tokens, from, to, right, wrong);
	while (from < to) {
		const guint end = part_end(tokens, from, to, "AND", "&");
		GString *part = g_string_new(NULL);
		const int value = end > from ? say_part(asked, tokens, from, end, part) : -1;
		GString *into = value ? right : wrong;

		if (value >= 0)
			g_string_append_printf(into, "%s%s", into->len ? _("; and ") : "", part->str);
		all = value < 0 ? -1 : all < 0 ? -1 : all && value;
		g_string_free(part, TRUE);
		from = end + 1;
	}
	return all;
}

static char *say(const struct asked *asked, GArray *tokens)
{
	GString *why = g_string_new(NULL);
	bool on = false, known = true;

	for (guint from = 0; from < tokens->len && !on;) {
		const guint end = part_end(tokens, from, tokens->len, "OR", NULL);
		GString *right = g_string_new(NULL), *wrong = g_string_new(NULL);
		const int value = say_way(asked, tokens, from, end, right, wrong);

		on = value == 1;
		known = known && value >= 0;
		if (on)
			g_string_assign(why, right->str);
		else
			g_string_append_printf(why, "%s%s", why->len ? _("; and ") : "", wrong->str);
		g_string_free(right, TRUE);
		g_string_free(wrong, TRUE);
		from = end + 1;
	}
	if (on || known)
		g_string_prepend(why, on ? _("TRUE: ") : _("FALSE: "));
	return g_string_free(why, !on && !known);
}

/* Takes over @tokens. */
static char *say_tokens(LadderSim *sim, const char *pou, int network, GArray *tokens)
{
	const struct twin *twin = ladder_sim_twin(sim);
	struct ladder *ladder = ladder_sim_ladder(sim);
	struct asked asked = { sim, pou, network, NULL, NULL };
	char *said = NULL;

	if (twin && ladder && ladder_project(ladder)) {
		asked.image = &twin->resource.image;
		asked.project = ladder_project(ladder);
		said = say(&asked, tokens);
	}
	g_array_unref(tokens);
	return said;
}

char *st_why(LadderSim *sim, const char *pou, const char *text, int line)
{
	GArray *tokens = condition_at(text, line);

	return tokens ? say_tokens(sim, pou, -1, tokens) : NULL;
}

char *st_why_network(LadderSim *sim, const char *pou, int network, const char *text)
{
	GArray *tokens = g_array_new(FALSE, FALSE, sizeof(struct token));
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END)
		g_array_append_val(tokens, lex.token);
	return say_tokens(sim, pou, network, tokens);
}
