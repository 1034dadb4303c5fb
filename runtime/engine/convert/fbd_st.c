/* SPDX-License-Identifier: MIT
 *
 * fbd_st - networks as Structured Text: their lines are statements, wires become variables.
 *
 * A wire keeps its value until its line runs again, so its variable is no VAR_TEMP. The value before
 * (PREVIOUS) is kept where the network begins.
 */
#include "engine/convert/networks.h"

#include "engine/base/ascii.h"
#include "engine/model/fbd.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <string.h>

static const char *text_of(const struct networks *n, uint32_t id)
{
	return project_text(n->acts->project, id);
}

static void refuse(struct networks *n, const char *what)
{
	const struct pou *pou = n->acts->pou;

	n->acts->refused = true;
	diag_add(n->acts->diags, (struct diag){ .id = DIAG_CONVERT_EDGE, .file = pou->file,
		 .line = pou->st->item[n->item].line, .pou = text_of(n, pou->name) }, "%s", what);
}

static void refuse_stop(struct networks *n, const struct st_item *item)
{
	const struct pou *pou = n->acts->pou;

	n->acts->refused = true;
	diag_add(n->acts->diags, (struct diag){ .id = DIAG_CONVERT_STOP, .file = pou->file, .line = item->line,
						.pou = text_of(n, pou->name) },
		 "STOP" DIAG_AND "%s", pou_language_word(LANGUAGE_ST));
}

uint32_t networks_wire(struct networks *n, const char *name, size_t len, bool before)
{
	struct acts *acts = n->acts;
	const uint32_t was = fbd_wire_name(&acts->project->names, name, len, n->network, before);
	const int at = vars_find(&acts->pou->vars, names_fold(&acts->project->names, was));
	char text[LIMIT_NAME + 16];
	struct act_edge *taken;
	struct wire *wire;

	if (at < 0)
		return 0;
	for (int i = 0; i < n->wires; i++)
		if (n->wire[i].var == &acts->pou->vars.var[at])
			return n->wire[i].is;
	snprintf(text, sizeof(text), "%.*s%s", (int)(len > LIMIT_NAME - 16 ? LIMIT_NAME - 16 : len), name,
		 before ? "_before" : "");
	wire = arena_push(acts->arena, &n->wire, &n->wires, sizeof(*wire));
	if (!wire) {
		acts->failed = true;
		return 0;
	}
	if (n->scoped)
		scope_network(acts->scope, acts->pou, -1);
	*wire = (struct wire){ acts_name(acts, text), &acts->pou->vars.var[at] };
	if (n->scoped)
		scope_network(acts->scope, acts->pou, n->network);
	taken = arena_push(acts->arena, &acts->edge, &acts->edges, sizeof(*taken)); /* its name is taken */
	if (taken)
		*taken = (struct act_edge){ .name = wire->is, .other = true };
	acts->failed |= !taken;
	return wire->is;
}

/* Bytes of the name up to its first dot. */
static size_t first_part(const struct token *token)
{
	const char *dot = memchr(token->text, '.', token->len);

	return dot ? (size_t)(dot - token->text) : token->len;
}

static bool is_call(const struct lex *lex, const char *word)
{
	struct lex next = *lex;

	if (!lex_is(lex, word))
		return false;
	lex_next(&next);
	return lex_is(&next, "(");
}

static bool is_pin(const struct lex *lex, int open)
{
	struct lex next = *lex;

	lex_next(&next);
	return open > 0 && (lex_is(&next, ":=") || lex_is(&next, "=>"));
}

/* Is it a name or a constant, perhaps with NOT, up to the closing parenthesis? What can fail, or runs code, may
 * not be moved in front of its statement. */
static bool is_simple(struct lex lex)
{
	int open = 1;

	while (open > 0 && lex_next(&lex) != TOKEN_END) {
		if (lex.token.kind == TOKEN_NAME) {
			struct lex next = lex;

			lex_next(&next);
			if (lex_is(&next, "(") && !lex_is(&lex, "NOT") && !lex_is(&lex, "AND") && !lex_is(&lex, "OR") &&
			    !lex_is(&lex, "XOR"))
				return false;
		}
		if (lex_is(&lex, "[") || lex_is(&lex, "^") || lex_is(&lex, "+") || lex_is(&lex, "-") ||
		    lex_is(&lex, "*") || lex_is(&lex, "/") || lex_is(&lex, "MOD") || lex_is(&lex, "**"))
			return false;
		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")");
	}
	return open == 0;
}

/* Functions that can always be computed. */
static bool is_sure(const struct lex *lex)
{
	static const char *const words[] = { "NOT", "AND", "OR", "XOR", "SEL", "MIN", "MAX", "LIMIT", "GT", "GE", "EQ",
					     "LE", "LT", "NE", "R_EDGE", "F_EDGE", "PREVIOUS" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(lex, words[i]))
			return true;
	return false;
}

/* Is anything computed before byte @at that can fail? Then an edge there is not computed each time. */
static bool fails_before(const struct st_item *item, const struct names *names, const char *at)
{
	bool call[LIMIT_EXPR_DEPTH + 1] = { false };
	bool name = false, sure = true;
	struct lex lex;
	int open = 0;

	lex_init(&lex, names_text(names, item->text), names_len(names, item->text));
	while (lex_next(&lex) != TOKEN_END && lex.token.text < at) {
		if (lex_is(&lex, "[") || lex_is(&lex, "^") || lex_is(&lex, "+") || lex_is(&lex, "-") ||
		    lex_is(&lex, "*") || lex_is(&lex, "/") || lex_is(&lex, "MOD") || lex_is(&lex, "**"))
			return true;
		if (lex_is(&lex, "(") && open < LIMIT_EXPR_DEPTH)
			call[++open] = name && !sure;
		else if (lex_is(&lex, ")") && open > 0 && call[open--])
			return true;
		name = lex.token.kind == TOKEN_NAME;
		sure = name && is_sure(&lex);
	}
	return false;
}

/* May an edge of the statement be called before it: no EN, no lazy operator and no call of one's own in it? */
static bool may_precede(struct networks *n, const struct st_item *item)
{
	struct names *names = &n->acts->project->names;
	struct lex lex;

	lex_init(&lex, names_text(names, item->text), names_len(names, item->text));
	while (lex_next(&lex) != TOKEN_END) {
		if (lex_is(&lex, "EN") || lex_is(&lex, "AND_THEN") || lex_is(&lex, "OR_ELSE"))
			return false;
		if (lex.token.kind == TOKEN_NAME &&
		    scope_pou(n->acts->scope, n->acts->pou, names_intern(names, lex.token.text, lex.token.len)))
			return false;
	}
	return true;
}

static void put_range(struct networks *n, struct lex *lex, int until, const struct sink *sink, const struct sink *before);

/* R_EDGE(value): its instance is called in front of the statement. */
static void put_edge(struct networks *n, struct lex *lex, bool rising, const struct sink *sink,
		     const struct sink *before)
{
	struct acts *acts = n->acts;
	struct lex inner = *lex;
	struct act_edge *edge;
	char name[LIMIT_NAME + 16];
	uint32_t id;

	lex_next(&inner); /* ( */
	if (!is_simple(inner) || !may_precede(n, &acts->pou->st->item[n->item]) ||
	    fails_before(&acts->pou->st->item[n->item], &acts->project->names, lex->token.text))
		refuse(n, rising ? "R_EDGE" : "F_EDGE");
	lex_next(&inner);
	if (inner.token.kind == TOKEN_NAME && !memchr(inner.token.text, '.', inner.token.len) &&
	    !lex_is(&inner, "NOT") && !(inner.token.len > 4 && ascii_is("SYS_", inner.token.text, 4)))
		snprintf(name, sizeof(name), "%.*s_%s", (int)(inner.token.len > 200 ? 200 : inner.token.len),
			 inner.token.text, rising ? "rises" : "falls");
	else
		snprintf(name, sizeof(name), "Net%d_edge", n->network + 1);
	id = acts_name(acts, name);
	edge = arena_push(acts->arena, &acts->edge, &acts->edges, sizeof(*edge));
	if (!edge) {
		acts->failed = true;
		return;
	}
	*edge = (struct act_edge){ .name = id, .rising = rising };
	lex_next(lex); /* ( */
	lex_next(lex);
	sink_text(before, text_of(n, id));
	sink_text(before, "(CLK := ");
	put_range(n, lex, 1, before, before);
	sink_text(before, ");\n");
	sink_text(sink, text_of(n, id));
	sink_text(sink, ".Q");
}

static void put_name(struct networks *n, struct lex *lex, int open, const struct sink *sink)
{
	const size_t part = first_part(&lex->token);
	const uint32_t wire = is_pin(lex, open) ? 0 : networks_wire(n, lex->token.text, part, false);

	if (!wire) {
		sink_write(sink, lex->token.text, lex->token.len);
		return;
	}
	sink_text(sink, text_of(n, wire));
	sink_write(sink, lex->token.text + part, lex->token.len - part);
}

/* The tokens from the present one on, up to the parenthesis that closes @until open ones, which is stepped on
 * but not written; 0: to the end. */
static void put_range(struct networks *n, struct lex *lex, int until, const struct sink *sink,
		      const struct sink *before)
{
	int open = until;
	bool member = false;

	for (; lex->token.kind != TOKEN_END; lex_next(lex)) {
		open += lex_is(lex, "(");
		open -= lex_is(lex, ")");
		if (until && open == 0)
			return;
		sink_text(sink, lex->token.space_before ? " " : "");
		if (!member && (is_call(lex, "R_EDGE") || is_call(lex, "F_EDGE"))) {
			put_edge(n, lex, lex_is(lex, "R_EDGE"), sink, before);
		} else if (!member && is_call(lex, "PREVIOUS")) {
			lex_next(lex);
			lex_next(lex);
			sink_text(sink, text_of(n, networks_wire(n, lex->token.text, lex->token.len, true)));
			lex_next(lex);
		} else if (!member && lex->token.kind == TOKEN_NAME) {
			put_name(n, lex, open, sink);
		} else {
			sink_write(sink, lex->token.text, lex->token.len);
		}
		member = lex_is(lex, ".");
	}
}

void networks_text(struct networks *n, const char *text, size_t len, const struct sink *sink,
		     const struct sink *before)
{
	struct lex lex;

	lex_init(&lex, text, len);
	lex.wide = true;
	lex_next(&lex);
	put_range(n, &lex, 0, sink, before);
}

/* The value behind S=, R= or IF; NULL: there is none. */
static const char *behind_word(const char *text, size_t len, enum st_kind kind)
{
	struct lex lex;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		if (kind == ST_SET || kind == ST_RESET) {
			if ((lex_is(&lex, "S") || lex_is(&lex, "R")) && lex.token.text[lex.token.len] == '=')
				return lex.token.text + lex.token.len + 1;
		} else if (lex_is(&lex, "IF")) {
			return lex.token.text + lex.token.len;
		}
	}
	return NULL;
}

void networks_statement(struct networks *n, const struct st_item *item, const struct sink *line,
		     const struct sink *before)
{
	const char *text = text_of(n, item->text);
	const size_t len = names_len(&n->acts->project->names, item->text);
	const char *value = behind_word(text, len, (enum st_kind)item->kind);
	const bool latch = item->kind == ST_SET || item->kind == ST_RESET;
	const struct token label = st_label_name(&n->acts->project->names, item);

	if (item->kind == ST_COMMENT) {
		sink_write(line, text, len);
		sink_text(line, "\n");
		return;
	}
	if (item->kind == ST_STOP_IF) {
		refuse_stop(n, item);
		return;
	}
	if (!latch && item->kind != ST_JUMP_IF && item->kind != ST_RETURN_IF) {
		networks_text(n, text, len, line, before);
		sink_text(line, ";\n");
		return;
	}
	if (value) {
		sink_text(line, "IF ");
		networks_text(n, value, (size_t)(text + len - value), line, before);
		sink_text(line, " THEN\n");
	}
	if (latch) {
		size_t target = value ? (size_t)(value - text) - 2 : len;

		while (target > 0 && text[target - 1] == ' ')
			target--;
		networks_text(n, text, target, line, before);
		sink_text(line, item->kind == ST_SET ? " := TRUE;\n" : " := FALSE;\n");
	} else if (item->kind == ST_JUMP_IF) {
		sink_text(line, "JMP ");
		sink_write(line, label.text, label.len);
		sink_text(line, ";\n");
	} else {
		sink_text(line, "RETURN;\n");
	}
	sink_text(line, value ? "END_IF;\n" : "");
}

static size_t quoted(const char *text, size_t len)
{
	size_t at = 1;

	while (at < len && text[at] != text[0])
		at += text[at] == '$' ? 2 : 1;
	return at < len ? at + 1 : len;
}

static size_t comment_length(const char *text, size_t len)
{
	const char *end;

	if (len < 2 || (memcmp(text, "(*", 2) != 0 && memcmp(text, "//", 2) != 0))
		return 0;
	if (*text == '/') {
		end = memchr(text, '\n', len);
		return end ? (size_t)(end - text) : len;
	}
	for (size_t at = 2, depth = 1; at + 1 < len; at++) {
		depth += memcmp(text + at, "(*", 2) == 0;
		if (memcmp(text + at, "*)", 2) == 0 && --depth == 0)
			return at + 2;
	}
	return len;
}

size_t networks_comment(const char *text, size_t len, size_t *at)
{
	size_t found = 0;

	while (*at < len && !(found = comment_length(text + *at, len - *at)))
		*at += text[*at] == '\'' || text[*at] == '"' ? quoted(text + *at, len - *at) : 1;
	return found;
}

/* Comments inside of a line stand above it: its words are written anew. */
static void put_inside(struct networks *n, const struct st_item *item)
{
	const char *text = text_of(n, item->text);
	size_t len = names_len(&n->acts->project->names, item->text), found;

	for (size_t at = 0; item->kind != ST_COMMENT && (found = networks_comment(text, len, &at)) > 0; at += found) {
		sink_write(n->sink, text + at, found);
		sink_text(n->sink, "\n");
	}
}

static void put_lines(struct networks *n, const struct fbd_network *network)
{
	const struct pou *pou = n->acts->pou;

	for (int i = 0; i < network->count; i++) {
		struct sink_memory line, before;

		sink_memory_init(&line);
		sink_memory_init(&before);
		const struct sink to_line = sink_to_memory(&line), to_before = sink_to_memory(&before);

		n->item = network->first + i;
		put_inside(n, &pou->st->item[n->item]);
		networks_statement(n, &pou->st->item[n->item], &to_line, &to_before);
		sink_text(n->sink, sink_memory_text(&before));
		sink_text(n->sink, sink_memory_text(&line));
		n->acts->failed |= line.failed || before.failed;
		sink_memory_free(&line);
		sink_memory_free(&before);
	}
}

bool networks_kept(struct networks *n, int *at, uint32_t *before, uint32_t *wire, enum iec_type *type)
{
	const struct var_table *vars = &n->acts->pou->vars;
	char end[16];
	const size_t size = (size_t)snprintf(end, sizeof(end), ".P%d", n->network + 1);

	for (; *at < vars->count; ++*at) {
		const char *name = text_of(n, vars->var[*at].name);
		const size_t len = strlen(name);

		if (!(vars_flags(vars, *at) & VAR_WIRE) || len <= size || strcmp(name + len - size, end) != 0)
			continue;
		*type = vars->var[*at].type;
		*before = networks_wire(n, name, len - size, true);
		*wire = networks_wire(n, name, len - size, false);
		++*at;
		return true;
	}
	return false;
}

/* Sum_before := Sum; of each wire that PREVIOUS names. */
static void put_kept(struct networks *n)
{
	uint32_t before, wire;
	enum iec_type type;
	int at = 0;

	while (networks_kept(n, &at, &before, &wire, &type)) {
		sink_text(n->sink, text_of(n, before));
		sink_text(n->sink, " := ");
		sink_text(n->sink, text_of(n, wire));
		sink_text(n->sink, ";\n");
	}
}

bool networks_lead(const struct networks *n, uint32_t label)
{
	const struct st *st = n->acts->pou->st;
	struct names *names = &n->acts->project->names;

	for (int i = 0; i < st->count; i++) {
		const struct token name = st_label_name(names, &st->item[i]);

		if (st->item[i].kind == ST_JUMP_IF &&
		    names_fold(names, names_intern(names, name.text, name.len)) == names_fold(names, label))
			return true;
	}
	return false;
}

static void put_commented(const struct networks *n, const char *text, size_t len)
{
	while (len) {
		const char *end = memchr(text, '\n', len);
		const size_t line = end ? (size_t)(end - text) : len;

		sink_text(n->sink, "// ");
		sink_write(n->sink, text, line);
		sink_text(n->sink, "\n");
		text += line + (end != NULL);
		len -= line + (end != NULL);
	}
}

static void put_network(struct networks *n, const struct fbd_network *network)
{
	const struct pou *pou = n->acts->pou;

	sink_text(n->sink, n->network ? "\n" : "");
	if (network->comment) {
		sink_text(n->sink, text_of(n, network->comment));
		sink_text(n->sink, "\n");
	}
	put_commented(n, text_of(n, network->title), strlen(text_of(n, network->title)));
	if (network->label && networks_lead(n, network->label)) {
		sink_text(n->sink, text_of(n, network->label));
		sink_text(n->sink, ":\n");
	}
	if (!network->off) {
		put_kept(n);
		put_lines(n, network);
		return;
	}
	for (int i = 0; i < network->count; i++) {
		const uint32_t text = pou->st->item[network->first + i].text;

		put_commented(n, text_of(n, text), names_len(&n->acts->project->names, text));
	}
}

void networks_declare(const struct networks *n, const struct sink *sink)
{
	for (int i = 0; i < n->wires; i++) {
		sink_text(sink, i ? "" : "VAR\n");
		sink_text(sink, text_of(n, n->wire[i].is));
		sink_text(sink, " : ");
		project_write_type(n->acts->project, n->wire[i].var, sink);
		sink_text(sink, ";\n");
	}
	sink_text(sink, n->wires ? "END_VAR\n" : "");
}

bool fbd_st(struct acts *acts, const struct sink *sink)
{
	struct networks *n = arena_alloc(acts->arena, sizeof(*n));
	struct sink_memory memory;

	if (!n) {
		acts->failed = true;
		return false;
	}
	sink_memory_init(&memory);
	const struct sink body = sink_to_memory(&memory);

	n->acts = acts;
	n->sink = &body;
	for (int i = 0; i < acts->pou->fbd->count; i++) {
		n->network = i;
		put_network(n, &acts->pou->fbd->network[i]);
	}
	networks_declare(n, sink);
	st_declare(acts, sink);
	sink_text(sink, sink_memory_text(&memory));
	acts->failed |= memory.failed;
	sink_memory_free(&memory);
	return !acts->failed && !acts->refused;
}
