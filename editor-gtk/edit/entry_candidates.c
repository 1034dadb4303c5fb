/* SPDX-License-Identifier: MIT
 *
 * entry_candidates - candidates for the word before the cursor, best first.
 *
 * All candidates exist, except new names at the end of the list, which say so: taking the
 * first one declares nothing if anything fits. entry_read() finds the addresses of a new
 * name and the meaning of the line.
 */
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/ladder.h"
#include "engine/model/expr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
	WANT_WORD = 1, WANT_BOOL = 2, WANT_ANY = 4, WANT_INSTANCE = 8, WANT_LABEL = 16,
	WANT_ROUTINE = 32, WANT_PIN_NAME = 64, WANT_NEW = 128,
	WANT_FUNCTION = 256,
};

struct search {
	const struct entry_place *place;
	const char *line;
	size_t cursor, from;       /* the word is line[from … cursor)          */
	size_t head;               /* bytes up to its last dot; 0: none        */
	unsigned int want;
	uint16_t classes;          /* fitting classes of values; 0: any        */
	bool write;
	const struct word_row *row; /* row of the line's word; NULL: none      */
	enum word word;
	struct entry_candidate *out;
	int count, most;
	int *rank;                 /* of each in out                           */
	enum word_kind adds;       /* of the word that add_words() adds; WORD_ELEM: none */
};

/* ---- which candidates are wanted, by the text before the word ---- */

static bool is_part(char c)
{
	return (c >= '0' && c <= '9') || ascii_upper(c) != c || (c >= 'A' && c <= 'Z') ||
	       c == '_' || c == '%' || c == '.' || (c & 0x80);
}

static void want_operand(struct search *s)
{
	switch (s->row->operand) {
	case OPND_BOOL_R:
		s->want = WANT_BOOL | WANT_NEW;
		return;
	case OPND_BOOL_W:
		s->want = WANT_BOOL | WANT_NEW;
		s->write = true;
		return;
	case OPND_LABEL:
		s->want = WANT_LABEL;
		return;
	case OPND_ROUTINE:
		s->want = WANT_ROUTINE;
		return;
	case OPND_EXPR:
	case OPND_ASSIGN:
		s->want = WANT_ANY | WANT_FUNCTION;
		return;
	case OPND_LOOP:
	case OPND_ANY_R:
	case OPND_ANY_W:
		s->want = WANT_ANY;
		return;
	case OPND_NONE:
	case OPND_LOOP_END:
	case OPND_EXECUTE:
	case OPND_INSTANCE:
	case OPND_PIN:
		return;
	}
}

/* Behind `PT:=`: values that fit this pin. */
static void want_value(struct search *s, const char *rest, size_t len)
{
	size_t from;
	int pin;

	while (len > 0 && strchr(":=>/ ", rest[len - 1]))
		len--;
	for (from = len; from > 0 && is_part(rest[from - 1]); from--)
		;
	pin = word_pin_find(s->row, rest + from, len - from);
	s->want = WANT_ANY;
	if (pin < 0)
		return;
	s->classes = entry_fit_pin(s->row, s->row->kind == WORD_FN ?
				   word_input(s->row, (uint32_t)pin) : &s->row->pin[pin],
				   IEC_NONE, false).classes;
}

/* Classes of values by position: of a block its inputs that are not BOOL; 0: any. */
static uint16_t classes_of_inputs(const struct word_row *row)
{
	uint16_t classes = 0;

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if ((pin->dir == PIN_IN || pin->dir == PIN_IN_OUT) &&
		    (row->kind == WORD_FN || pin->type != IEC_BOOL))
			classes |= entry_fit_pin(row, pin, IEC_NONE, false).classes;
	}
	return classes;
}

/* Behind a word: an operand, an instance, parameters. */
static void want_behind(struct search *s, const char *rest, size_t len)
{
	size_t end = len;

	if (s->row->kind == WORD_ELEM) {
		want_operand(s);
		return;
	}
	while (end > 0 && rest[end - 1] == ' ')
		end--;
	if (end > 0 && strchr("=>/", rest[end - 1])) {
		want_value(s, rest, end);
		return;
	}
	s->want = WANT_PIN_NAME;
	if (s->row->kind == WORD_FB && end == 0) {
		s->want |= WANT_INSTANCE;
		return;
	}
	s->want |= WANT_ANY;
	s->classes = classes_of_inputs(s->row);
}

/* The part of an expression before the word. */
struct before {
	enum { SIGN_NONE, SIGN_ASSIGN, SIGN_COMPARE, SIGN_SUM } sign; /* the last one */
	uint16_t target, left; /* classes of the target, of the first value since; 0: unknown */
};

static uint16_t classes_of(const struct search *s, const struct token *token)
{
	struct entry_target target;

	entry_target_find(s->place, token->text, token->len, &target);
	return target.means == MEANS_VALUE && !target.array ?
	       entry_fit_type(target.type, false).classes : 0;
}

static void take_sign(struct before *before, const struct lex *lex)
{
	static const char *const compare[] = { "<", ">", "<=", ">=", "=", "<>" };
	static const char *const sum[] = { "+", "-", "*", "/", "**" };

	for (size_t i = 0; i < sizeof(compare) / sizeof(*compare); i++)
		if (lex_is(lex, compare[i])) {
			before->sign = SIGN_COMPARE;
			return;
		}
	for (size_t i = 0; i < sizeof(sum) / sizeof(*sum); i++)
		if (lex_is(lex, sum[i])) {
			before->sign = SIGN_SUM;
			return;
		}
	before->sign = SIGN_NONE;
	if (lex_is(lex, ":=")) {
		before->sign = SIGN_ASSIGN;
		before->target = before->left;
	}
	before->left = 0;
}

static struct before read_before(const struct search *s, const char *text, size_t len)
{
	static const char *const logic[] = { "AND", "OR", "XOR", "NOT" };
	struct before before = { .sign = SIGN_NONE };
	struct lex lex;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		bool is_logic = false;

		for (size_t i = 0; i < sizeof(logic) / sizeof(*logic); i++)
			is_logic = is_logic || lex_is(&lex, logic[i]);
		if (is_logic || lex.token.kind == TOKEN_SYMBOL)
			take_sign(&before, &lex);
		else if (lex_is(&lex, "MOD"))
			before.sign = SIGN_SUM;
		else if (!before.left && lex.token.kind != TOKEN_NUMBER)
			before.left = classes_of(s, &lex.token);
	}
	return before;
}

/* In an expression: values that fit what stands before them. A number is not a name. */
static void want_value_in(struct search *s, const char *text)
{
	const struct before before = read_before(s, text, (size_t)(s->line + s->from - text));

	s->write = false;
	s->want = ascii_digit(s->line[s->from]) ? 0 : WANT_ANY | WANT_FUNCTION;
	if (before.sign == SIGN_ASSIGN)
		s->classes = before.target;
	else if (before.sign == SIGN_COMPARE)
		s->classes = before.left;
	else if (before.sign == SIGN_SUM)
		s->classes = before.left ? before.left : before.target ? before.target : ANY_NUM;
}

static void find_want(struct search *s)
{
	const char *line = s->line;
	size_t at = strspn(line, " \t"), glyph = entry_glyph(line + at, &s->word);
	size_t end = at;
	bool below;

	s->word = glyph ? s->word : WORD_COUNT;
	if (glyph) {
		end = at + glyph;
	} else {
		while (end < s->from && line[end] != ' ' && line[end] != '[')
			end++;
		if (end == at || end == s->from)
			end = at;
		else
			s->word = entry_word_find(s->place, line + at, end - at, &below);
	}
	s->write = s->place->output;
	s->want = WANT_WORD | WANT_BOOL | WANT_NEW;
	if (s->word != WORD_COUNT && s->from >= end && end > at) {
		s->row = words_row(&s->place->project->words, s->word);
		s->want = 0;
		s->write = false;
		want_behind(s, line + end, s->from - end);
	} else if (s->from > at && line[at] != '/' && line[at] != '!') {
		want_value_in(s, line + at + (line[at] == '['));
	}
}

/* ---- ranking ---- */

/* 0: equal, 1: begins with it, 2: contains it, -1: no match. */
static int fit(const char *text, const char *typed, size_t len)
{
	const size_t size = strlen(text);

	if (name_begins(typed, len, text, size))
		return name_same(typed, len, text, size) ? 0 : 1;
	for (size_t i = 1; i < size; i++)
		if (name_begins(typed, len, text + i, size - i))
			return 2;
	return -1;
}

/* Order of kinds that match equally well. */
static int kind_rank(const struct search *s, enum entry_kind kind)
{
	static const uint8_t ranks[] = {
		[ENTRY_VARIABLE] = 2, [ENTRY_INSTANCE] = 3, [ENTRY_PIN] = 3,
		[ENTRY_ADDRESS] = 4, [ENTRY_LABEL] = 2, [ENTRY_ROUTINE] = 2,
		[ENTRY_WORD] = 5, [ENTRY_NEW] = 9, [ENTRY_BITS] = 3,
	};

	if (kind == ENTRY_WORD && s->place->box && s->adds != WORD_ELEM)
		return s->adds == WORD_FB ? 0 : 1;
	if (kind == ENTRY_INSTANCE && s->want & WANT_INSTANCE)
		return 0;
	return kind == ENTRY_PIN && s->want & WANT_PIN_NAME ? 1 : ranks[kind];
}

/* Pins and parts stay in their order. */
static int compare(const struct search *s, enum entry_kind kind, int rank,
		   const char *text, int index)
{
	const struct entry_candidate *other = &s->out[index];

	if (rank != s->rank[index])
		return rank - s->rank[index];
	return kind == ENTRY_PIN || kind == ENTRY_BITS ? 1 : strcmp(text, other->text);
}

static void make_line(const struct search *s, const char *text, char *out, size_t size)
{
	snprintf(out, size, "%.*s%s%s", (int)s->from, s->line, text,
		 s->line + s->cursor);
}

/* The length of whole characters within @most bytes. */
static int whole_part(const char *text, int most)
{
	int len = (int)strlen(text);

	if (len <= most)
		return len;
	while (most > 0 && ((unsigned char)text[most] & 0xc0) == 0x80)
		most--;
	return most;
}

/* Places kept for a new name with each of its addresses; in a short list only one. */
static int kept(const struct search *s)
{
	if (!(s->want & (WANT_NEW | WANT_INSTANCE | WANT_ANY)))
		return 0;
	return s->most > 2 * ENTRY_CHOICES ? ENTRY_CHOICES : 1;
}

/* Keeps the list sorted; drops the last one when the list is full. */
static void add(struct search *s, enum entry_kind kind, int fits, const char *text,
		const char *address, const char *note, const char *comment)
{
	const int room = s->most - kept(s);
	const int rank = fits * 10 + kind_rank(s, kind);
	int at = s->count;
	struct entry_candidate *c;

	while (at > 0 && compare(s, kind, rank, text, at - 1) < 0)
		at--;
	if (fits < 0 || at >= room ||
	    (at > 0 && s->rank[at - 1] == rank && !strcmp(s->out[at - 1].text, text)))
		return;
	if (s->count == room)
		s->count--;
	memmove(&s->out[at + 1], &s->out[at],
		(size_t)(s->count - at) * sizeof(*s->out));
	memmove(&s->rank[at + 1], &s->rank[at],
		(size_t)(s->count - at) * sizeof(*s->rank));
	s->count++;
	s->rank[at] = rank;
	c = &s->out[at];
	memset(c, 0, sizeof(*c));
	c->kind = kind;
	snprintf(c->text, sizeof(c->text), "%s", text);
	snprintf(c->address, sizeof(c->address), "%s", address);
	snprintf(c->note, sizeof(c->note), "%s%s%.*s", note, !note[0] || !comment[0] ? "" :
		 kind == ENTRY_WORD ? " · " : " ", whole_part(comment, 200), comment);
	make_line(s, text, c->line, sizeof(c->line));
}

/* ---- candidates that exist ---- */

static const char *typed(const struct search *s)
{
	return s->line + s->from;
}

static size_t typed_len(const struct search *s)
{
	return s->cursor - s->from;
}

/* The shortest form of an address: I0.3 for %IX0.3. */
static void shorten(const char *text, size_t len, char *out, size_t size)
{
	size_t n = 0;

	for (size_t i = 0; i < len && n + 1 < size; i++)
		if (text[i] != '%' &&
		    (ascii_upper(text[i]) != 'X' || i == 0 || ascii_digit(text[i - 1])))
			out[n++] = text[i];
	out[n] = '\0';
}

static int fit_address(const struct search *s, const char *address)
{
	char mine[40], theirs[40];

	shorten(typed(s), typed_len(s), mine, sizeof(mine));
	shorten(address, strlen(address), theirs, sizeof(theirs));
	if (!mine[0])
		return typed_len(s) ? 2 : -1;
	return fit(theirs, mine, strlen(mine));
}

static const char *type_word(const struct search *s, const struct var *var)
{
	return var->type != IEC_NONE ? iec_type_row(var->type)->word :
		words_row(&s->place->project->words, var->fb)->word;
}

static bool is_wanted(const struct search *s, const struct var *var, uint16_t flags)
{
	const struct word_row *row = words_row(&s->place->project->words, var->fb);

	if (s->write && ((flags & (VAR_CONSTANT | VAR_INPUT)) ||
			 (var->at.area != AREA_NONE &&
			  iec_area_row(var->at.area)->access == ACCESS_READ)))
		return false;
	if (s->want & WANT_INSTANCE && var->type == IEC_NONE && var->fb == s->word)
		return true;
	if (s->want & WANT_ANY)
		return !s->classes || (var->type != IEC_NONE && var->array.count == 0 &&
				       iec_type_row(var->type)->class & s->classes);
	if (!(s->want & WANT_BOOL))
		return false;
	return var->type == IEC_BOOL ||
	       (var->type == IEC_NONE && !s->write && row->kind == WORD_FB);
}

static void add_table(struct search *s, const struct var_table *table)
{
	const struct project *project = s->place->project;

	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];
		const char *name = project_text(project, var->name);
		char address[40] = "";
		int fits = fit(name, typed(s), typed_len(s));

		if (var->at.area != AREA_NONE) {
			iec_addr_print(var->at, address, sizeof(address));
			if (fits < 0)
				fits = fit_address(s, address);
		}
		/* a wire has another name in its network */
		if (fits >= 0 && !(vars_flags(table, i) & VAR_WIRE) && is_wanted(s, var, vars_flags(table, i)))
			add(s, var->type == IEC_NONE ? ENTRY_INSTANCE : ENTRY_VARIABLE,
			    fits, name, address, type_word(s, var),
			    project_text(project, var->comment));
	}
}

/* Is it a number with bits? */
static bool has_bits(const struct entry_target *target)
{
	return target->means == MEANS_VALUE && !target->array && target->type != IEC_NONE &&
	       iec_type_row(target->type)->class & (ANY_INT | CLASS_BITS);
}

/* Bits and bytes of the number before the last dot. */
static void add_parts(struct search *s, const struct entry_target *number)
{
	static const enum iec_type type[] = { [1] = IEC_BOOL, [8] = IEC_BYTE, [16] = IEC_WORD, [32] = IEC_DWORD };
	const char *begun = typed(s) + s->head + 1;
	const size_t len = typed_len(s) - s->head - 1;
	char part[8], text[ENTRY_NAME];
	unsigned int bits;

	for (int i = 0; (bits = expr_part_print(8u * iec_type_row(number->type)->size, len && *begun == '%', i,
						part, sizeof(part))) > 0; i++) {
		if ((s->want & WANT_BOOL && bits != 1) || (s->write && !number->write) ||
		    (s->classes && !(iec_type_row(type[bits])->class & s->classes)))
			continue;
		snprintf(text, sizeof(text), "%.*s.%s", (int)s->head, typed(s), part);
		add(s, ENTRY_BITS, fit(part, begun, len), text, "", iec_type_row(type[bits])->word, "");
	}
}

/* Pins and members of the instance before the last dot, or parts of a number. */
static void add_pins(struct search *s)
{
	struct entry_target target;
	const struct word_row *row;
	char text[ENTRY_NAME];

	entry_target_find(s->place, typed(s), s->head, &target);
	if (has_bits(&target))
		add_parts(s, &target);
	if (target.means != MEANS_INSTANCE || target.array)
		return;
	row = words_row(&s->place->project->words, target.word);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const size_t skip = s->head + 1;

		if (pin->dir == PIN_VAR || !pin->name ||
		    (s->want & WANT_BOOL && pin->type != IEC_BOOL) ||
		    (s->write && row->kind == WORD_FB && pin->dir != PIN_IN))
			continue;
		snprintf(text, sizeof(text), "%.*s.%s", (int)s->head, typed(s), pin->name);
		add(s, ENTRY_PIN, fit(pin->name, typed(s) + skip, typed_len(s) - skip),
		    text, "", pin->type != IEC_NONE ? iec_type_row(pin->type)->word : "",
		    said(explain_pin(row, i)));
	}
}

static void add_address(void *context, struct iec_addr addr)
{
	struct search *s = context;
	char text[40];
	int fits;

	if ((s->want & WANT_BOOL && addr.bits != 1) ||
	    (s->classes &&
	     !(iec_type_row(iec_addr_type(addr))->class & s->classes)) ||
	    (s->write && iec_area_row(addr.area)->access == ACCESS_READ))
		return;
	iec_addr_print(addr, text, sizeof(text));
	fits = fit_address(s, text);
	if (fits >= 0)
		add(s, ENTRY_ADDRESS, fits, text, text,
		    iec_type_row(iec_addr_type(addr))->word, "");
}

static void add_system(struct search *s)
{
	for (int i = 0; i < SYS_COUNT && !s->write && typed_len(s) > 0; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);
		const int fits = fit(row->name, typed(s), typed_len(s));

		if (fits == 2 && typed_len(s) < 3)
			continue;
		if (s->want & WANT_BOOL ? row->type == IEC_BOOL :
		    !s->classes || iec_type_row(row->type)->class & s->classes)
			add(s, ENTRY_ADDRESS, fits, row->name, row->address, iec_type_row(row->type)->word,
			    said(explain_sys((enum sys_id)i)));
	}
}

static bool may_stand(const struct search *s, const struct word_row *row)
{
	return row->place == PLACE_LAST || row->place == PLACE_BOX ||
	       (row->place == PLACE_SERIES && !s->place->output);
}

static void add_words(struct search *s)
{
	const struct word_table *words = &s->place->project->words;
	const struct entry_mnemonic *m;

	for (int i = 0; (m = entry_mnemonic(i)) != NULL; i++)
		if (may_stand(s, word_row(m->word)) && typed_len(s) > 0)
			add(s, ENTRY_WORD, fit(m->text, typed(s), typed_len(s)), m->text,
			    "", word_row(m->word)->word,
			    said(explain_word(word_row(m->word))));
	for (int i = 0; i < WORD_KNOWN + words->count; i++) {
		const enum word word = (enum word)(i < WORD_KNOWN ? i :
						   WORD_FIRST_OWN + i - WORD_KNOWN);
		const struct word_row *row = words_row(words, word);

		if (!may_stand(s, row) || row->kind == WORD_STRUCT)
			continue;
		s->adds = row->kind;
		add(s, ENTRY_WORD, fit(row->word, typed(s), typed_len(s)), row->word, "",
		    said(explain_family(row)), said(words_explain(row)));
	}
	s->adds = WORD_ELEM;
}

static void add_function(void *context, const struct ladder_word *word,
			 const struct word_row *row)
{
	struct search *s = context;
	const int fits = fit(word->text, typed(s), typed_len(s));
	char text[ENTRY_NAME];

	if (fits > 1)
		return; /* a large project has too many to list */
	if (row && s->classes && !(entry_fit_result(row, IEC_NONE).classes & s->classes))
		return;
	snprintf(text, sizeof(text), "%s(", word->text);
	add(s, ENTRY_WORD, fits, text, "",
	    row ? said(explain_family(row)) : "", said(word->note));
}

static void add_labels(struct search *s)
{
	const struct pou *pou = entry_pou(s->place);

	for (int i = 0; pou && i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];
		const char *name = project_text(s->place->project, rung->label);

		if (rung->label)
			add(s, ENTRY_LABEL, fit(name, typed(s), typed_len(s)), name, "",
			    project_text(s->place->project, rung->title), "");
	}
}

static void add_routines(struct search *s)
{
	const struct project *project = s->place->project;

	for (int i = 0; i < project->pou_count; i++) {
		const char *name = project_text(project, project->pou[i].name);

		if (project->pou[i].kind == POU_SUBROUTINE)
			add(s, ENTRY_ROUTINE, fit(name, typed(s), typed_len(s)), name, "",
			    pou_word(POU_SUBROUTINE), "");
	}
}

/* Names of parameters, as `PT:=`. */
static void add_pin_names(struct search *s)
{
	const int first = s->row->kind == WORD_FB ? word_first_bool(s->row, PIN_IN) : -1;
	char text[LIMIT_NAME + 3];

	for (int i = 0; i < s->row->pin_count; i++) {
		const struct word_pin *pin = &s->row->pin[i];

		if (i == first || (pin->dir != PIN_IN && pin->dir != PIN_OUT &&
				   pin->dir != PIN_IN_OUT))
			continue;
		snprintf(text, sizeof(text), "%s%s", pin->name,
			 pin->dir == PIN_OUT ? "=>" : ":=");
		add(s, ENTRY_PIN, fit(pin->name, typed(s), typed_len(s)), text, "",
		    pin->type != IEC_NONE ? iec_type_row(pin->type)->word : "",
		    said(explain_pin(s->row, i)));
	}
}

/* ---- new names, with each address that they may get ---- */

static void add_row(struct search *s, const struct entry_new *declared,
		    const char *address, const char *more)
{
	struct entry_candidate *c = &s->out[s->count++];

	memset(c, 0, sizeof(*c));
	c->kind = ENTRY_NEW;
	snprintf(c->text, sizeof(c->text), "%s", declared->name);
	snprintf(c->address, sizeof(c->address), "%s", address);
	snprintf(c->note, sizeof(c->note), "%.100s%s%.200s", declared->type,
		 more[0] ? ", " : "", more);
}

/* The new line has the chosen address, so that it can be changed at once. It replaces the
 * text from @name_end, the end of the name, to the cursor. */
static void add_choices(struct search *s, const struct entry_new *declared,
			size_t name_end, const char *typed, size_t typed_len)
{
	for (int i = 0; i < declared->choices && s->count < s->most; i++) {
		const char *address = declared->choice[i];
		char *line = s->out[s->count].line;

		if (typed_len > strlen(address) || !ascii_same(address, typed, typed_len))
			continue;
		add_row(s, declared, address, address[0] ? "" : _("no address"));
		snprintf(line, ENTRY_TEXT, "%.*s%s%s%s", (int)name_end, s->line,
			 address[0] ? " AT " : " : ", address[0] ? address : declared->type,
			 s->line + s->cursor);
	}
}

static const struct entry_new *declared_as(const struct entry *entry, const char *name,
					   size_t len)
{
	for (int i = 0; i < entry->declares; i++)
		if (name_is(entry->declare[i].name, name, len))
			return &entry->declare[i];
	return NULL;
}

/* T37 is a timer, as in other tools; or it may be an ordinary name. */
static void add_bool(struct search *s, const char *name)
{
	struct entry_new plain = { .type = "BOOL" };

	if (s->count + 1 >= s->most)
		return;
	snprintf(plain.name, sizeof(plain.name), "%s", name);
	snprintf(s->out[s->count].line, ENTRY_TEXT, "%.*s : BOOL%s", (int)s->cursor, s->line,
		 s->line + s->cursor);
	add_row(s, &plain, "", _("no address"));
}

/* Adds the name if the line would declare it. */
static void add_name(struct search *s, struct entry *entry)
{
	const struct entry_new *declared;

	if (!entry_read(s->place, s->line, entry))
		return;
	declared = declared_as(entry, s->line + s->from, s->cursor - s->from);
	if (!declared)
		return;
	if (declared->choices > 0) {
		add_choices(s, declared, s->cursor, "", 0);
		return;
	}
	snprintf(s->out[s->count].line, ENTRY_TEXT, "%s", s->line);
	add_row(s, declared, declared->address, "");
	if (iec_type_find(declared->type, strlen(declared->type)) == IEC_NONE &&
	    s->want & WANT_BOOL)
		add_bool(s, declared->name);
}

/* Adds a new name at the end of the list. */
static void add_new(struct search *s)
{
	struct entry *entry = malloc(sizeof(*entry));

	if (entry && s->count < s->most && s->cursor > s->from)
		add_name(s, entry);
	free(entry);
}

/* ---- inside the declaration of a name ---- */

/* The start of the operand: behind a word, a glyph or a sign. */
static size_t operand_at(const struct search *s)
{
	static const char blanks[] = " \t";
	size_t at = strspn(s->line, blanks), len, glyph;
	enum word word;
	bool below;

	glyph = entry_glyph(s->line + at, &word);
	len = strcspn(s->line + at, blanks);
	if (glyph > 0)
		at += glyph;
	else if (!entry_declared_len(s->line + at, s->cursor - at, ENTRY_WORD_POSSIBLE) &&
		 entry_word_find(s->place, s->line + at, len, &below) != WORD_COUNT)
		at += len;
	at += strspn(s->line + at, blanks);
	if (s->line[at] == '/' || s->line[at] == '!')
		at += 1 + strspn(s->line + at + 1, blanks);
	return at;
}

/* The declaration at the cursor. */
struct saying {
	size_t name, name_end; /* in the line; name_end 0: no declaration      */
	bool type;             /* the cursor is in its type, else in its address */
};

static size_t back_blanks(const char *line, size_t at)
{
	while (at > 0 && (line[at - 1] == ' ' || line[at - 1] == '\t'))
		at--;
	return at;
}

/* The start of the word before @end, without signs; the colon of I:0/3 belongs to it. */
static size_t back_word(const char *line, size_t end)
{
	size_t at = end;

	while (at > 0 && (!strchr(" \t:=<>+-*&,;()[]", line[at - 1]) ||
			  (at < end && line[at - 1] == ':' && ascii_digit(line[at]))))
		at--;
	while (at < end && (line[at] == '/' || line[at] == '!'))
		at++;
	return at;
}

/* Finds `Level AT`, `Level AT %IW0 :` or `Level :` before the word, the word AT itself, or
 * the address of a contact or coil. */
static struct saying find_saying(const struct search *s)
{
	const char *line = s->line;
	size_t end = back_blanks(line, s->from), word;
	struct saying out = { .type = end > 0 && line[end - 1] == ':' };

	if (out.type)
		end = back_blanks(line, end - 1);
	word = back_word(line, end);
	if (ascii_is("AT", line + word, end - word)) {
		end = back_blanks(line, word);
	} else if (out.type && back_blanks(line, word) > 0) {
		const size_t at = back_word(line, back_blanks(line, word));

		if (ascii_is("AT", line + at, back_blanks(line, word) - at))
			end = back_blanks(line, at);
		else if (line[word] == '%' && at == operand_at(s))
			end = back_blanks(line, word);
	} else if (!out.type && !ascii_is("AT", line + s->from, s->cursor - s->from) &&
		   (line[s->from] != '%' || word != operand_at(s))) {
		return out;
	}
	word = back_word(line, end);
	if (entry_is_name(line + word, end - word)) {
		out.name = word;
		out.name_end = end;
	}
	return out;
}

/* Adds all types that fit. */
static void add_types(struct search *s, const struct saying *saying, struct entry *entry)
{
	const size_t len = s->cursor - s->from;

	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT && s->count < s->most; i++) {
		const char *word = iec_type_row((enum iec_type)i)->word;
		char *line = s->out[s->count].line;
		const struct entry_new *declared;

		if (len > strlen(word) || !ascii_same(word, s->line + s->from, len))
			continue;
		snprintf(line, ENTRY_TEXT, "%.*s%s%s", (int)s->from, s->line, word,
			 s->line + s->cursor);
		if (!entry_read(s->place, line, entry))
			continue;
		declared = declared_as(entry, s->line + saying->name,
				       saying->name_end - saying->name);
		if (declared)
			add_row(s, declared, declared->address, "");
	}
}

/* Adds addresses that begin with the word, or all behind AT. */
static void add_addresses(struct search *s, const struct saying *saying,
			  struct entry *entry)
{
	const char *typed = s->line + s->from;
	const size_t len = s->cursor - s->from;
	const struct entry_new *declared;
	char line[ENTRY_TEXT];

	snprintf(line, sizeof(line), "%.*s%s", (int)saying->name_end, s->line,
		 s->line + s->cursor);
	if (!entry_read(s->place, line, entry))
		return;
	declared = declared_as(entry, s->line + saying->name,
			       saying->name_end - saying->name);
	if (declared)
		add_choices(s, declared, saying->name_end, typed,
			    ascii_is("AT", typed, len) ? 0 : len);
}

/* Is the cursor in a declaration such as `AT %I`? Then types or addresses are offered. */
static bool add_said(struct search *s)
{
	const struct saying saying = find_saying(s);
	struct entry *entry;

	if (saying.name_end == 0)
		return false;
	entry = malloc(sizeof(*entry));
	if (entry && saying.type)
		add_types(s, &saying, entry);
	else if (entry)
		add_addresses(s, &saying, entry);
	free(entry);
	return true;
}

/* ---- all of them ---- */

static void find_all(struct search *s)
{
	const struct pou *pou = entry_pou(s->place);

	if (s->want & WANT_LABEL)
		add_labels(s);
	if (s->want & WANT_ROUTINE)
		add_routines(s);
	if (s->want & WANT_PIN_NAME)
		add_pin_names(s);
	if (s->head) {
		add_pins(s);
	} else if (s->want & (WANT_BOOL | WANT_ANY | WANT_INSTANCE)) {
		if (pou)
			add_table(s, &pou->vars);
		add_table(s, &s->place->project->globals);
	}
	if (s->want & (WANT_BOOL | WANT_ANY)) {
		add_system(s);
		if (typed_len(s) > 0)
			entry_each_address(s->place, add_address, s);
	}
	if (s->want & WANT_WORD)
		add_words(s);
	if (s->want & WANT_FUNCTION && typed_len(s) > 0)
		ladder_functions(s->place->project, typed(s), typed_len(s), add_function,
				 s);
	if (s->want & (WANT_NEW | WANT_INSTANCE | WANT_ANY))
		add_new(s);
}

/* Bytes up to the last dot of the word, if an instance, a structure or a number is before it. */
static size_t find_head(const struct search *s)
{
	struct entry_target target;
	size_t len = typed_len(s);

	while (len > 0 && typed(s)[len - 1] != '.')
		len--;
	if (len < 2)
		return 0;
	entry_target_find(s->place, typed(s), len - 1, &target);
	return target.means == MEANS_INSTANCE || has_bits(&target) ? len - 1 : 0;
}

static int search(const struct entry_place *place, const char *line, size_t cursor,
		  struct entry_candidate *out, int most)
{
	struct search s = { .place = place, .line = line, .out = out, .most = most };

	s.rank = calloc((size_t)most + 1, sizeof(*s.rank));
	if (!s.rank)
		return 0;
	s.cursor = cursor <= strlen(line) ? cursor : strlen(line);
	s.from = s.cursor;
	while (s.from > 0 && is_part(line[s.from - 1]))
		s.from--;
	s.head = find_head(&s);
	if (!add_said(&s)) {
		find_want(&s);
		find_all(&s);
	}
	free(s.rank);
	return s.count;
}

int entry_candidates(const struct entry_place *place, const char *line, size_t cursor,
		     struct entry_candidate *out, int most)
{
	struct entry_place known = *place;
	struct xref own;
	int count;

	if (most <= 0 || strlen(line) >= ENTRY_TEXT || !utf8_valid(line, strlen(line), NULL))
		return 0;
	if (place->xref)
		return search(place, line, cursor, out, most);
	known.xref = &own;
	count = xref_addresses(&own, place->project) ?
		search(&known, line, cursor, out, most) : 0;
	xref_free(&own);
	return count;
}

const char *entry_kind_text(enum entry_kind kind)
{
	static const char *const texts[] = {
		[ENTRY_VARIABLE] = N_("variable"), [ENTRY_INSTANCE] = N_("instance"),
		[ENTRY_PIN] = N_("pin"), [ENTRY_ADDRESS] = N_("address"),
		[ENTRY_LABEL] = N_("label"), [ENTRY_ROUTINE] = N_("subroutine"),
		[ENTRY_WORD] = N_("word"), [ENTRY_NEW] = N_("new"),
		[ENTRY_BITS] = N_("part of a number"),
	};

	return texts[kind];
}
