/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_body - conditions and actions as subroutines, their rungs and lines as they are.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

#include "engine/text/text.h"

#include <stdlib.h>

static void write_rungs(struct lad *e, const struct sfc_body *body)
{
	for (int i = 0; i < body->count; i++) {
		char *text = text_write_rung(e->project, e->pou->rung[body->first + i]);

		e->good &= text != NULL;
		if (text)
			sink_text(&e->subs, lad_words(e, text));
		free(text);
	}
}

static void write_list(struct lad *e, const struct sfc_body *body, const char *result)
{
	const struct il il = { .line = e->pou->il.line + body->first,
			       .count = body->count };
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	text_write_il(e->project, &il, &sink);
	e->good &= !memory.failed;
	sink_text(&e->subs, lad_words(e, sink_memory_text(&memory)));
	sink_memory_free(&memory);
	if (!result)
		return;
	sink_text(&e->subs, "ST ");
	sink_text(&e->subs, result);
	sink_text(&e->subs, "\n");
}

void lad_body(struct lad *e, int number, const char *result)
{
	const struct sfc_body *body = sfc_body(e->sfc, number);

	e->condition = result;
	sink_text(&e->subs, "SUBROUTINE ");
	sink_text(&e->subs, project_text(e->project, e->body[number]));
	sink_text(&e->subs, body->kind == BODY_LIST ? " IL\n" : " LD\n");
	if (body->kind == BODY_LIST)
		write_list(e, body, result);
	else
		write_rungs(e, body);
	sink_text(&e->subs, "END_SUBROUTINE\n\n");
	e->condition = NULL;
}
