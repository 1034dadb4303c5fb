/* SPDX-License-Identifier: MIT
 *
 * sfc - the words of a chart, the resolution of its names, and the variables it
 * declares.
 *
 * check/check_sfc.c reports errors.
 */
#include "engine/model/sfc.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char *const qualifiers[QUALIFIER_COUNT] = {
	"N", "S", "R", "L", "D", "P", "P0", "P1", "SD", "DS", "SL",
};
static const char *const controls[CONTROL_COUNT] = {
	"RESET", "HOLD", "SEMI", "MANUAL", "TIP", "FORCE",
};

static int find(const char *const *words, int count, const char *text, size_t len)
{
	int i = 0;

	while (i < count && (strlen(words[i]) != len || strncasecmp(words[i], text, len)))
		i++;
	return i;
}

const char *qualifier_word(enum qualifier qualifier)
{
	return qualifiers[qualifier];
}

enum qualifier qualifier_find(const char *text, size_t len)
{
	return (enum qualifier)find(qualifiers, QUALIFIER_COUNT, text, len);
}

bool qualifier_has_time(enum qualifier qualifier)
{
	return qualifier == QUALIFIER_L || qualifier == QUALIFIER_D ||
	       qualifier == QUALIFIER_SD || qualifier == QUALIFIER_DS ||
	       qualifier == QUALIFIER_SL;
}

const char *control_word(enum control control)
{
	return controls[control];
}

enum control control_find(const char *text, size_t len)
{
	return (enum control)find(controls, CONTROL_COUNT, text, len);
}

const struct sfc_word *sfc_word(int i)
{
	static const struct sfc_word words[] = {
		{ "STEP", SFC_WORD_STEP }, { "INITIAL_STEP", SFC_WORD_STEP },
		{ "MACRO_STEP", SFC_WORD_STEP }, { "TRANSITION", SFC_WORD_TRANSITION },
		{ "ACTION", SFC_WORD_ACTION }, { "CONTROL", SFC_WORD_CONTROL },
		{ "SET", SFC_WORD_SETTING }, { "RESET", SFC_WORD_SETTING },
		{ "END_STEP", SFC_WORD_END }, { "END_TRANSITION", SFC_WORD_END },
		{ "END_ACTION", SFC_WORD_END },
	};

	return i >= 0 && i < (int)(sizeof(words) / sizeof(*words)) ? &words[i] : NULL;
}

bool sfc_reserved(const char *name)
{
	/* Words that can stand where a name does. */
	static const char *const words[] = { SFC_CONDITION, "FROM", "TO" };

	return find(words, 3, name, strlen(name)) < 3;
}

int sfc_bodies(const struct sfc *sfc)
{
	return sfc->transition_count + sfc->action_count;
}

const struct sfc_body *sfc_body(const struct sfc *sfc, int body)
{
	return body < sfc->transition_count ? &sfc->transition[body].condition :
	       &sfc->action[body - sfc->transition_count].body;
}

bool sfc_body_has_rungs(const struct sfc_body *body)
{
	return body->kind == BODY_EXPRESSION || body->kind == BODY_RUNGS;
}

int sfc_find_step(const struct sfc *sfc, const struct names *names, uint32_t name)
{
	const uint32_t fold = names_fold(names, name);

	for (int i = 0; fold && i < sfc->step_count; i++)
		if (names_fold(names, sfc->step[i].name) == fold)
			return i;
	return -1;
}

/* ---- names ---- */

/* By folded name: the number of a step or action; -1: none. The first of a name is
 * used. */
static int *by_fold(struct names *names, const uint32_t *name, size_t stride, int count)
{
	int *out = arena_alloc(names->arena, ((size_t)names->count + 1) * sizeof(*out));

	for (int i = 0; out && i < names->count; i++)
		out[i] = -1;
	for (int i = count - 1; out && i >= 0; i--) {
		const char *at = (const char *)name + (size_t)i * stride;
		uint32_t id;

		memcpy(&id, at, sizeof(id));
		out[names_fold(names, id)] = i;
	}
	return out;
}

bool sfc_link(struct sfc *sfc, struct names *names)
{
	const struct sfc_step *steps = sfc->step;
	const struct sfc_action *actions = sfc->action;
	const int *step = by_fold(names, steps ? &steps->name : NULL, sizeof(*steps),
				  sfc->step_count);
	const int *action = by_fold(names, actions ? &actions->name : NULL,
				    sizeof(*actions), sfc->action_count);

	if (!step || !action)
		return false;
	for (int i = 0; i < sfc->ref_count; i++) {
		struct sfc_ref *ref = &sfc->ref[i];

		ref->step = ref->name ? step[names_fold(names, ref->name)] : -1;
	}
	for (int i = 0; i < sfc->use_count; i++) {
		struct sfc_use *use = &sfc->use[i];

		use->action = use->operand ?
			      action[names_fold(names, use->operand)] : -1;
	}
	return true;
}

/* ---- variables of a chart ---- */

int sfc_x(const struct sfc *sfc, const struct var_table *table, int step)
{
	return table->block[sfc->block].first + step;
}

int sfc_t(const struct sfc *sfc, const struct var_table *table, int step)
{
	return sfc_x(sfc, table, sfc->step_count + step);
}

int sfc_condition(const struct sfc *sfc, const struct var_table *table)
{
	return sfc_x(sfc, table, 2 * sfc->step_count);
}

static bool declare(struct names *names, struct var_table *table, struct arena *arena,
		    struct var var, const char *name)
{
	var.name = names_intern(names, name, strlen(name));
	var.fold = names_fold(names, var.name);
	return var.name && vars_push(table, table->block_count - 1, &var, arena);
}

static bool declare_steps(const struct sfc *sfc, struct names *names,
			  struct var_table *table, struct arena *arena,
			  enum iec_type type, char letter)
{
	char name[LIMIT_NAME + 8];

	for (int i = 0; i < sfc->step_count; i++) {
		const struct sfc_step *step = &sfc->step[i];

		snprintf(name, sizeof(name), "%.*s.%c", LIMIT_NAME,
			 names_text(names, step->name), letter);
		if (!declare(names, table, arena,
			     (struct var){ .type = type, .line = step->line }, name))
			return false;
	}
	return true;
}

/* ---- what a chart in a block remembers ---- */

static uint64_t hash_text(uint64_t hash, const char *text)
{
	do
		hash = (hash ^ (uint8_t)*text) * 1099511628211u;
	while (*text++);
	return hash;
}

static uint32_t kept_name(struct names *names, const char *what, uint64_t hash)
{
	char text[40];
	const int len = snprintf(text, sizeof(text), "_%.8s_%016llx", what, (unsigned long long)hash);

	return names_intern(names, text, (size_t)len);
}

uint32_t sfc_use_name(const struct sfc *sfc, struct names *names, const char *what, int number)
{
	const struct sfc_use *use = &sfc->use[number];
	uint64_t hash = hash_text(14695981039346656037u, names_text(names, sfc->step[use->step].name));

	hash = hash_text(hash, names_text(names, use->operand));
	return kept_name(names, what, hash_text(hash, qualifier_word(use->qualifier)));
}

uint32_t sfc_called_name(struct names *names, const char *what, uint32_t name)
{
	return kept_name(names, what, hash_text(14695981039346656037u, names_text(names, name)));
}

/* Two uses of a step may be alike. */
static bool declare_once(struct names *names, struct var_table *table, struct arena *arena,
			 enum iec_type type, uint32_t name)
{
	return name && (vars_find(table, names_fold(names, name)) >= 0 ||
			declare(names, table, arena, (struct var){ .type = type }, names_text(names, name)));
}

static bool declare_kept(const struct sfc *sfc, struct names *names, struct var_table *table, struct arena *arena)
{
	static const struct { const char *name; enum iec_type type; } own[] = {
		{ "_Runs", IEC_BOOL }, { "_Last", IEC_TIME }, { "_ResetWas", IEC_BOOL },
		{ "_TipWas", IEC_BOOL }, { "_ForceWas", IEC_DINT },
	};
	const struct var fired = { .type = IEC_BOOL, .has_init = true, .init = { .i = sfc_starts_itself(sfc) } };
	bool good = declare(names, table, arena, fired, "_Fired");
	char due[24];

	for (size_t i = 0; i < sizeof(own) / sizeof(*own) && good; i++)
		good = declare(names, table, arena, (struct var){ .type = own[i].type }, own[i].name);
	for (int i = 0; i < sfc->use_count && good; i++)
		good = declare_once(names, table, arena, IEC_BOOL, sfc_use_name(sfc, names, "Kept", i)) &&
		       declare_once(names, table, arena, IEC_BOOL, sfc_use_name(sfc, names, "Wait", i)) &&
		       declare_once(names, table, arena, IEC_TIME, sfc_use_name(sfc, names, "Since", i)) &&
		       declare_once(names, table, arena, IEC_BOOL,
				    sfc_called_name(names, "Was", sfc->use[i].operand));
	for (int i = 0; i < sfc->action_count && good; i++)
		good = declare_once(names, table, arena, IEC_BOOL,
				    sfc_called_name(names, "Was", sfc->action[i].name));
	for (int i = 0; i < sfc->use_count + sfc->action_count && good; i++) { /* one behind the other */
		snprintf(due, sizeof(due), "_Due%d", i + 1);
		good = declare(names, table, arena, (struct var){ .type = IEC_BOOL }, due);
	}
	return good;
}

bool sfc_declare(struct sfc *sfc, struct names *names, struct var_table *table,
		   struct arena *arena, bool kept)
{
	struct var_block *block = arena_push(arena, &table->block, &table->block_count,
					     sizeof(*block));

	if (!block)
		return false;
	*block = (struct var_block){ .flags = VAR_SFC, .first = table->count };
	sfc->block = table->block_count - 1;
	return declare_steps(sfc, names, table, arena, IEC_BOOL, 'X') &&
	       declare_steps(sfc, names, table, arena, IEC_TIME, 'T') &&
	       declare(names, table, arena, (struct var){ .type = IEC_BOOL },
		       SFC_CONDITION) && (!kept || declare_kept(sfc, names, table, arena));
}

bool sfc_starts_itself(const struct sfc *sfc)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (sfc->control[i])
			return false;
	return !sfc_goes_round(sfc);
}

bool sfc_rests_at_once(const struct sfc *sfc)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (sfc->control[i])
			return false;
	return sfc_goes_round(sfc);
}

bool sfc_goes_round(const struct sfc *sfc)
{
	return sfc->evolution != EVOLVE_ONCE;
}

const char *sfc_evolution_words(enum sfc_evolution evolution)
{
	static const char *const words[] = {
		[EVOLVE_ONCE] = "", [EVOLVE_UNTIL_STABLE] = "UNTIL STABLE",
		[EVOLVE_IN_ORDER] = "IN ORDER",
	};

	return words[evolution];
}
