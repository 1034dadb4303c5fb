/* SPDX-License-Identifier: MIT
 *
 * cmd_why - `ladder why`: runs a script and prints which conditions block the power of a
 * coil, or let it through.
 */
#include "ladder/report.h"

#include "engine/base/name.h"
#include "engine/trial/value.h"
#include "engine/trial/why.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct asked {
	struct call *call;
	const struct project *project;
	const struct resource *resource;
	const char *coil;
	struct location at;      /* of the coil; IEC_NONE: local to a block        */
	struct why *why;
	int found;
	bool failed;
};

static void print_cell(const struct sink *out, const struct why_cell *cell, bool on)
{
	sink_text(out, "  ");
	sink_printf(out, why_text(cell->kind, on), cell->name);
	sink_printf(out, " (%d,%d)", cell->row, cell->col);
	if (*cell->values) {
		sink_text(out, ": ");
		sink_text(out, cell->values);
	}
	sink_text(out, "\n");
}

static void print_ways(const struct sink *out, const struct why *why)
{
	for (int i = 0; i < why->ways; i++) {
		if (i)
			sink_text(out, why->on ? "and\n" : "or\n");
		for (int k = 0; k < why->way[i].count; k++)
			print_cell(out, &why->way[i].cell[k], why->on);
		if (!why->way[i].count)
			sink_text(out, "  the left rail\n");
	}
	if (why->more)
		sink_text(out, "and more\n");
}

static void print_answer(struct asked *asked, const struct why_place *place,
			 const char *name)
{
	const struct sink *out = &asked->call->out;
	const struct why *why = asked->why;
	const struct pou *pou = &asked->project->pou[place->pou];

	sink_text(out, name);
	sink_printf(out, " has %s: ", why->on ? "power" : "no power");
	sink_text(out, place->instance ? place->instance :
		  project_text(asked->project, pou->name));
	sink_printf(out, " rung %d (%d,%d)\n", place->rung, place->row, place->col);
	if (why->whole != WHY_COUNT) {
		sink_text(out, "  ");
		sink_printf(out, why_text(why->whole, false), why->name);
		sink_text(out, "\n");
	}
	print_ways(out, why);
}

static void answer(struct asked *asked, const struct why_place *place, const char *name)
{
	struct arena arena;

	arena_init(&arena);
	if (why_ask(place, &arena, asked->why))
		print_answer(asked, place, name);
	else
		asked->failed = true;
	arena_free(&arena);
	asked->found++;
}

/* Is @operand another name of the coil's bit, such as %QX0.1? */
static bool is_same(const struct asked *asked, const char *operand)
{
	struct location at;
	enum diag_id why;

	if (asked->at.type != IEC_BOOL || asked->at.constant || !*operand)
		return false;
	at = value_find(&asked->resource->image, operand, strlen(operand), &why);
	return at.type == IEC_BOOL && at.area == asked->at.area &&
	       at.where == asked->at.where;
}

/* Does COIL name this coil? `Motor`, `Main.Motor`, `Belt1.Motor`; `Main:3` names all coils
 * of a rung. */
static bool is_asked(const struct asked *asked, const char *body, int rung,
		     const char *operand, bool inside)
{
	const char *coil = asked->coil;
	/* The body may be spelled otherwise there: up to the colon or the point behind it. */
	const size_t named = strcspn(coil, ":");
	const size_t len = coil[named] && name_is(body, coil, named) ? named :
			   name_head(body, strlen(body), coil, strlen(coil));
	char number[16];

	snprintf(number, sizeof(number), ":%d", rung);
	if (len > 0) {
		if (strcmp(coil + len, number) == 0)
			return true;
		if (coil[len] == '.' && *operand &&
		    name_is(operand, coil + len + 1, strlen(coil) - len - 1))
			return true;
	}
	return !inside && ((*operand && name_is(operand, coil, strlen(coil))) ||
			   is_same(asked, operand));
}

static void ask_rung(struct asked *asked, struct why_place *place, const char *body)
{
	const struct pou *pou = &asked->project->pou[place->pou];
	const struct rung *rung = pou->rung[place->rung - 1];

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		const struct word_row *row = words_row(&asked->project->words,
						       (enum word)cell->word);
		const char *name = project_text(asked->project, cell->operand);

		if (row->place != PLACE_LAST && row->operand != OPND_ASSIGN)
			continue;
		if (!is_asked(asked, body, place->rung, name, place->instance))
			continue;
		place->row = i / rung->cols + 1;
		place->col = i % rung->cols + 1;
		answer(asked, place, *name ? name : row->word);
	}
}

static void ask_body(struct asked *asked, int pou, const char *instance)
{
	struct why_place place = { .project = asked->project, .pou = pou,
				   .resource = asked->resource, .instance = instance };
	const char *body = instance ? instance :
		project_text(asked->project, asked->project->pou[pou].name);

	for (place.rung = 1; place.rung <= asked->project->pou[pou].rung_count;
	     place.rung++)
		ask_rung(asked, &place, body);
}

static enum status ask(struct call *call, struct machine *machine)
{
	struct asked asked = {
		.call = call, .project = ladder_project(machine->ladder),
		.resource = &machine->resource, .coil = call->arg[2],
		.why = calloc(1, sizeof(*asked.why)),
	};
	const struct program *program = machine->resource.image.program;
	enum diag_id why;

	if (!asked.why)
		return report_no_memory(call->arg[0]);
	asked.at = value_find(&machine->resource.image, asked.coil, strlen(asked.coil), &why);
	for (int i = 0; i < asked.project->pou_count; i++)
		if (!pou_has_frame(&asked.project->pou[i]))
			ask_body(&asked, i, NULL);
	for (uint32_t i = 0; i < program->watched_count; i++)
		ask_body(&asked, (int)program->watched[i].pou,
			 program->string + program->watched[i].name);
	free(asked.why);
	if (asked.failed)
		return report_no_memory(call->arg[0]);
	return asked.found ? STATUS_GOOD : report_missing(call, "coil or rung", asked.coil);
}

/* Explains the state after the last scan, also if that was a fault or a STOP. */
static enum status run(struct call *call, struct machine *machine, const char *text,
		       size_t len)
{
	enum status status = machine_play(machine, call->arg[1], text, len), answered;

	if (status != STATUS_GOOD && machine->resource.state != STATE_FAULT)
		return status;
	answered = ask(call, machine);
	return answered > status ? answered : status;
}

enum status cmd_why(struct call *call)
{
	const char *plant = call_option(call, "--plant");
	struct machine machine = { 0 };
	enum status status = STATUS_WRONG;
	size_t len;
	char *text = report_read(call->arg[1], &len);

	if (text)
		status = machine_open(&machine, call->arg[0], MACHINE_WATCHED);
	if (status == STATUS_GOOD && !ladder_project(machine.ladder))
		status = report_no_text(call->arg[0]);
	if (status == STATUS_GOOD && plant)
		status = machine_add_plant(&machine, plant,
					   (struct diag){ .file = "--plant" });
	if (status == STATUS_GOOD)
		status = run(call, &machine, text, len);
	machine_close(&machine);
	free(text);
	return status;
}
