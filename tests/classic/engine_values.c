/* SPDX-License-Identifier: MIT
 *
 * engine_values - variables of a ClassicLadder project, by code and by name.
 *
 * Memory behind arrays, which ClassicLadder reads and writes, is not imitated: reads give 0.
 */
#include "tests/classic/engine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int bases[] = { 60000, 1000, 100 };

static bool is_lc(const struct engine *engine)
{
	return engine->project->dialect == CLASSIC_LINUXCNC;
}

/* The array of bits of a type; NULL: it has none. */
static uint8_t *bit_of(const struct engine *engine, int type)
{
	switch (type) {
	case V_BIT:
		return engine->bit;
	case V_STEP_A:
		return engine->step_a;
	case V_INPUT:
		return engine->input;
	case V_OUTPUT:
		return engine->output;
	case V_LED:
		return engine->led;
	case V_SYSTEM:
		return engine->system;
	case V_ERROR:
		return engine->error;
	default:
		return NULL;
	}
}

static int32_t *word_of(const struct engine *engine, int type)
{
	switch (type) {
	case V_WORD:
		return engine->word;
	case V_STEP_V:
		return engine->step_v;
	case V_INPUT_WORD:
		return engine->input_word;
	case V_OUTPUT_WORD:
	case V_OUTPUT_FLOAT:
		return engine->output_word;
	case V_SYSTEM_WORD:
		return engine->system_word;
	default:
		return NULL;
	}
}

static int32_t block_get(const struct engine *engine, int type, int64_t at)
{
	const struct fifo *fifo = &engine->fifo[at];

	switch (type) {
	case V_TIMER_D:
		return engine->timer[at].done;
	case V_TIMER_R:
		return engine->timer[at].running;
	case V_TIMER_P:
		return engine->timer[at].preset / engine->timer[at].base;
	case V_TIMER_V:
		return engine->timer[at].value / engine->timer[at].base;
	case V_IEC_Q:
		return engine->iec[at].q;
	case V_IEC_P:
		return engine->iec[at].preset;
	case V_IEC_V:
		return engine->iec[at].value;
	case V_MONO_R:
		return engine->mono[at].running;
	case V_MONO_P:
		return engine->mono[at].preset / engine->mono[at].base;
	case V_MONO_V:
		return engine->mono[at].value / engine->mono[at].base;
	case V_COUNTER_D:
		return engine->counter[at].done;
	case V_COUNTER_E:
		return engine->counter[at].empty;
	case V_COUNTER_F:
		return engine->counter[at].full;
	case V_COUNTER_P:
		return engine->counter[at].preset;
	case V_COUNTER_V:
		return engine->counter[at].value;
	case V_REGISTER_E:
		return fifo->empty;
	case V_REGISTER_F:
		return fifo->full;
	case V_REGISTER_I:
		return fifo->in;
	case V_REGISTER_O:
		return fifo->out;
	case V_REGISTER_S:
		return fifo->count;
	default:
		return 0;
	}
}

int32_t engine_get(const struct engine *engine, int type, int64_t number)
{
	if (number < 0 || number >= CLASSIC_LIMIT)
		return 0;
	if (is_lc(engine) && type == V_INPUT_FLOAT)
		return engine->input_number[number];
	if (bit_of(engine, type))
		return bit_of(engine, type)[number];
	if (word_of(engine, type))
		return word_of(engine, type)[number];
	return block_get(engine, type, number);
}

void engine_set(struct engine *engine, int type, int64_t number, int32_t value)
{
	if (number < 0 || number >= CLASSIC_LIMIT)
		return;
	if (is_lc(engine) && type == V_INPUT_FLOAT)
		engine->input_number[number] = value;
	else if (bit_of(engine, type))
		bit_of(engine, type)[number] = value != 0;
	else if (word_of(engine, type))
		word_of(engine, type)[number] = value;
	else if (type == V_TIMER_P)
		engine->timer[number].preset =
			(int32_t)((uint32_t)value * (uint32_t)engine->timer[number].base);
	else if (type == V_MONO_P)
		engine->mono[number].preset =
			(int32_t)((uint32_t)value * (uint32_t)engine->mono[number].base);
	else if (type == V_IEC_P)
		engine->iec[number].preset = value;
	else if (type == V_COUNTER_P)
		engine->counter[number].preset = value;
	else if (type == V_COUNTER_V)
		engine->counter[number].value = value;
	else if (type == V_REGISTER_I)
		engine->fifo[number].in = value;
}

int64_t engine_at(const struct engine *engine, const struct classic_variable *variable)
{
	int64_t number = variable->number;

	if (variable->index_type >= 0)
		number += engine_get(engine, variable->index_type, variable->index_number);
	return number;
}

void engine_reset(struct engine *engine)
{
	const struct classic_project *project = engine->project;
	size_t all = CLASSIC_LIMIT, words = all * 4;

	memset(engine->bits, 0, 8 * all);
	memset(engine->word, 0, words);
	memset(engine->input_word, 0, words);
	memset(engine->input_number, 0, words);
	memset(engine->output_word, 0, words);
	memset(engine->system_word, 0, words);
	memset(engine->step_v, 0, words);
	memset(engine->list, 0, 4 * ((size_t)engine->fifos *
				     (size_t)project->register_list + 1));
	memset(engine->edge, 0, (size_t)project->rungs * sizeof(*engine->edge));
	for (size_t i = 0; i < all; i++) {
		engine->timer[i] = (struct old_timer){ .base = 1000 };
		engine->mono[i] = (struct monostable){ .base = 1000 };
		engine->iec[i] = (struct iec_timer){ .base = 1000 };
		engine->counter[i] = (struct counter){ 0 };
		engine->fifo[i] = (struct fifo){ 0 };
	}
	for (int i = 0; i < project->timer.count; i++) {
		const struct classic_block *block = &project->timer.block[i];
		struct old_timer *timer = &engine->timer[block->number];

		timer->base = bases[block->base];
		timer->value = timer->preset = block->preset * timer->base;
	}
	for (int i = 0; i < project->monostable.count; i++) {
		const struct classic_block *block = &project->monostable.block[i];
		struct monostable *mono = &engine->mono[block->number];

		mono->base = bases[block->base];
		mono->preset = block->preset * mono->base;
	}
	for (int i = 0; i < project->iec_timer.count; i++) {
		const struct classic_block *block = &project->iec_timer.block[i];

		engine->iec[block->number] = (struct iec_timer){
			.base = bases[block->base], .preset = block->preset,
			.mode = block->mode };
	}
	for (int i = 0; i < project->counter.count; i++)
		engine->counter[project->counter.block[i].number].preset =
			project->counter.block[i].preset;
	for (int i = 0; i < project->reg.count; i++)
		engine->fifo[project->reg.block[i].number].mode = project->reg.block[i].mode;
	for (int i = 0; i < project->steps; i++) {
		engine->active[i] = project->step[i].initial;
		engine->active_ms[i] = 0;
	}
	engine->scans = 0;
	engine->stopped = false;
}

/* ---- names ---- */

struct form { const char *prefix, *attribute; int type; };

static const struct form forms[] = {
	{ "QLED", "", V_LED }, { "TM", ".Q", V_IEC_Q }, { "TM", ".P", V_IEC_P },
	{ "TM", ".V", V_IEC_V }, { "T", ".D", V_TIMER_D }, { "T", ".R", V_TIMER_R },
	{ "T", ".P", V_TIMER_P }, { "T", ".V", V_TIMER_V }, { "M", ".R", V_MONO_R },
	{ "M", ".P", V_MONO_P }, { "M", ".V", V_MONO_V }, { "C", ".D", V_COUNTER_D },
	{ "C", ".E", V_COUNTER_E }, { "C", ".F", V_COUNTER_F }, { "C", ".P", V_COUNTER_P },
	{ "C", ".V", V_COUNTER_V }, { "X", ".A", V_STEP_A }, { "X", ".V", V_STEP_V },
	{ "R", ".E", V_REGISTER_E }, { "R", ".F", V_REGISTER_F }, { "R", ".I", V_REGISTER_I },
	{ "R", ".O", V_REGISTER_O }, { "R", ".S", V_REGISTER_S }, { "IW", "", V_INPUT_WORD },
	{ "QW", "", V_OUTPUT_WORD }, { "SW", "", V_SYSTEM_WORD }, { "IF", "", V_INPUT_FLOAT },
	{ "QF", "", V_OUTPUT_FLOAT }, { "B", "", V_BIT }, { "I", "", V_INPUT },
	{ "Q", "", V_OUTPUT }, { "S", "", V_SYSTEM }, { "E", "", V_ERROR }, { "W", "", V_WORD }
};

int engine_name(const struct engine *engine, const char *text, int *type, int *number)
{
	if (*text != '%')
		return 0;
	for (size_t i = 0; i < sizeof(forms) / sizeof(*forms); i++) {
		const struct form *form = &forms[i];
		size_t prefix = strlen(form->prefix), attribute = strlen(form->attribute);
		const char *at = text + 1 + prefix;
		char *end;
		long value;

		if (form->type == V_INPUT_FLOAT && (form->prefix[0] == 'I') != is_lc(engine))
			continue;
		if (strncmp(text + 1, form->prefix, prefix) != 0 || *at < '0' || *at > '9')
			continue;
		value = strtol(at, &end, 10);
		if (strncmp(end, form->attribute, attribute) != 0 || value >= CLASSIC_LIMIT)
			continue;
		*type = form->type;
		*number = (int)value;
		return (int)(end + attribute - text);
	}
	return 0;
}

void engine_print(const struct engine *engine, int type, int number, char *out,
		  size_t size)
{
	for (size_t i = 0; i < sizeof(forms) / sizeof(*forms); i++) {
		const struct form *form = &forms[i];

		if (form->type != type ||
		    (type == V_INPUT_FLOAT && (form->prefix[0] == 'I') != is_lc(engine)))
			continue;
		snprintf(out, size, "%%%s%d%s", form->prefix, number, form->attribute);
		return;
	}
	snprintf(out, size, "?%d/%d", type, number);
}
