/* SPDX-License-Identifier: MIT
 *
 * lists - the lists that run as the bodies of POUs.
 */
#include "engine/convert/convert.h"

#include "engine/check/wires.h"
#include "engine/convert/networks.h"
#include "engine/model/fbd.h"
#include "engine/text/pou_print.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

/* A comment of the POU. It stands in the list where that of rung @rung begins, or else before what comes from line
 * @line of the file, or behind that. */
struct note {
	uint32_t rung, line, text;
	bool behind;
};

struct notes {
	struct project *project;
	struct note *note;     /* by rung, then by line                        */
	int count, room;
	bool failed;
};

/* Copies to @out the variables of @temp that the list uses; the others are for watching.
 * Returns how many; -1: no memory. */
static int pick_used(const struct project *project, const struct il *il,
		     struct var *const *temp, int count, struct var *out)
{
	uint8_t *used = calloc((size_t)count + 1, 1);
	int kept = 0;

	if (!used || !pou_temps_used(&project->names, il, temp, count, used)) {
		free(used);
		return -1;
	}
	for (int i = 0; i < count; i++)
		if (used[i])
			out[kept++] = *temp[i];
	free(used);
	return kept;
}

/* Adds the temporaries of translation to the variables of @pou, in a block of their own. */
static bool add_temporaries(struct project *project, struct pou *pou,
			    struct var *const *temp, int count)
{
	struct var_table *table = &pou->vars;
	size_t vars = (size_t)table->count, blocks = (size_t)table->block_count;
	struct var *var = arena_alloc(&project->arena, sizeof(*var) *
				      (vars + (size_t)count));
	struct var_block *block = arena_alloc(&project->arena, sizeof(*block) *
					      (blocks + 1));

	if (!var || !block)
		return false;
	count = pick_used(project, &pou->il, temp, count, var + vars);
	if (count <= 0)
		return count == 0;
	if (vars)
		memcpy(var, table->var, sizeof(*var) * vars);
	if (blocks)
		memcpy(block, table->block, sizeof(*block) * blocks);
	block[blocks].first = table->count;
	block[blocks].count = count;
	table->var = var;
	table->block = block;
	table->count += count;
	table->block_count++;
	return true;
}

/* ---- comments ---- */

static void add_note(struct notes *n, struct note note, const char *text, size_t len)
{
	if (n->count == n->room) {
		const int room = n->room ? 2 * n->room : 64;
		struct note *grown = realloc(n->note, sizeof(*grown) * (size_t)room);

		if (!grown) {
			n->failed = true;
			return;
		}
		n->note = grown;
		n->room = room;
	}
	note.text = names_intern(&n->project->names, text, len);
	n->failed |= !note.text;
	n->note[n->count++] = note;
}

static void add_id(struct notes *n, struct note note, uint32_t id)
{
	if (id)
		add_note(n, note, project_text(n->project, id), names_len(&n->project->names, id));
}

/* Each line of @text behind slashes. */
static void add_lines(struct notes *n, struct note note, const char *text, size_t len)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	for (size_t at = 0; at < len;) {
		const char *end = memchr(text + at, '\n', len - at);
		const size_t line = end ? (size_t)(end - text) - at : len - at;

		sink_text(&sink, at ? "\n// " : "// ");
		sink_write(&sink, text + at, line);
		at += line + 1;
	}
	n->failed |= memory.failed;
	if (len)
		add_note(n, note, sink_memory_text(&memory), memory.len);
	sink_memory_free(&memory);
}

static void add_title(struct notes *n, struct note note, uint32_t title)
{
	if (title)
		add_lines(n, note, project_text(n->project, title), names_len(&n->project->names, title));
}

static void rung_notes(struct notes *n, const struct rung *rung, uint32_t number)
{
	const struct note note = { .rung = number };

	if (rung->off) {
		char *text = text_write_rung(n->project, rung);

		n->failed |= !text;
		if (text)
			add_lines(n, note, text, strlen(text) - (text[0] && text[strlen(text) - 1] == '\n'));
		free(text);
		return;
	}
	add_id(n, note, rung->comment);
	add_title(n, note, rung->title);
	for (int i = 0; i < rung->rows * rung->cols; i++)
		add_id(n, note, rung->cell[i].comment);
}

/* Comments between statements and inside of them. */
static void item_notes(struct notes *n, const struct st_item *item, int count)
{
	for (int i = 0; i < count; i++) {
		const char *text = project_text(n->project, item[i].text);
		const size_t len = names_len(&n->project->names, item[i].text);
		const struct note note = { .line = (uint32_t)item[i].line, .behind = item[i].behind };
		size_t found;

		if (item[i].kind == ST_COMMENT) {
			add_note(n, note, text, len);
			continue;
		}
		for (size_t at = 0; (found = networks_comment(text, len, &at)) > 0; at += found)
			add_note(n, note, text + at, found);
	}
}

static void network_notes(struct notes *n, const struct pou *pou, int number)
{
	const struct fbd_network *network = &pou->fbd->network[number];
	const struct note note = { .line = (uint32_t)network->line };
	struct sink_memory memory;

	if (!network->off) {
		add_id(n, note, network->comment);
		add_title(n, note, network->title);
		item_notes(n, pou->st->item + network->first, network->count);
		return;
	}
	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	text_write_network(n->project, pou, number, &sink);
	n->failed |= memory.failed;
	add_lines(n, note, sink_memory_text(&memory), memory.len - (memory.len > 0));
	sink_memory_free(&memory);
}

static void pou_notes(struct notes *n, const struct pou *pou)
{
	if (pou->language == LANGUAGE_LD)
		for (int i = 0; i < pou->rung_count; i++)
			rung_notes(n, pou->rung[i], (uint32_t)i + 1);
	if (pou->fbd)
		for (int i = 0; i < pou->fbd->count; i++)
			network_notes(n, pou, i);
	else if (pou->st)
		item_notes(n, pou->st->item, pou->st->count);
}

/* Notes are taken one after another: those of rungs stand first. */
struct at_note {
	int rung, line;        /* the next one of each kind                    */
	uint32_t first, last;  /* lines of the POU's own text                  */
};

static void put_note(struct il *to, const struct notes *n, int at, uint32_t line)
{
	il_add(to, (struct il_line){ .kind = IL_COMMENT, .operand = n->note[at].text, .line = line });
}

/* What stands before @line of the list that was made. */
static void put_before(struct il *to, const struct notes *n, struct at_note *place, const struct il_line *line)
{
	const bool head = line->kind == IL_COMMENT, own = line->line >= place->first && line->line <= place->last;
	const uint32_t last = to->count ? to->line[to->count - 1].line : 0;

	for (; place->rung < n->count && n->note[place->rung].rung &&
	       n->note[place->rung].rung + head <= line->rung; place->rung++)
		put_note(to, n, place->rung, 0);
	for (; place->line < n->count; place->line++) {
		const struct note *note = &n->note[place->line];
		const bool passed = own && note->line < line->line + !note->behind;

		if (!passed && !(note->behind && last == note->line && line->line != last))
			break;
		put_note(to, n, place->line, note->behind && last == note->line ? last : 0);
	}
}

/* The list with the comments of @pou, which is none yet. */
static bool put_notes(struct project *project, const struct pou *pou, struct il *il)
{
	struct notes n = { .project = project };
	struct il to = { .arena = il->arena };
	struct at_note place = { .first = UINT32_MAX };
	bool good;

	pou_notes(&n, pou);
	while (place.line < n.count && n.note[place.line].rung)
		place.line++;
	for (int i = 0; pou->st && i < pou->st->count; i++) {
		const uint32_t line = (uint32_t)pou->st->item[i].line;

		place.first = line < place.first ? line : place.first;
		place.last = line > place.last ? line : place.last;
	}
	for (int i = 0; i < il->count; i++) {
		put_before(&to, &n, &place, &il->line[i]);
		il_add(&to, il->line[i]);
	}
	for (; place.rung < n.count && n.note[place.rung].rung; place.rung++)
		put_note(&to, &n, place.rung, 0);
	for (const uint32_t last = il->count ? il->line[il->count - 1].line : 0; place.line < n.count; place.line++)
		put_note(&to, &n, place.line, n.note[place.line].behind && last == n.note[place.line].line ? last : 0);
	good = !n.failed && to.count == il->count + n.count;
	free(n.note);
	*il = to;
	return good;
}

/* R_EDGE and F_EDGE say it already. */
static void drop_edges(struct il *il)
{
	int kept = 0;

	for (int i = 0; i < il->count; i++)
		if (!(il->line[i].mark & IL_ENTERS))
			il->line[kept++] = il->line[i];
	il->count = kept;
}

bool convert_to_il(struct project *project, int number, const struct il *list, struct var *const *temp,
		   int temp_count)
{
	struct pou *pou = &project->pou[number];

	pou->il = *list;
	drop_edges(&pou->il);
	if (pou->language != LANGUAGE_IL && pou->language != LANGUAGE_SFC && !put_notes(project, pou, &pou->il))
		return false;
	pou->language = LANGUAGE_IL;
	pou->sfc = NULL;
	pou->st = NULL;
	if (pou->fbd && !wires_declare(project, pou, &pou->il))
		return false;
	pou->fbd = NULL;
	if (!add_temporaries(project, pou, temp, temp_count))
		return false;
	for (int k = 0; k < pou->rung_count; k++)
		rung_free(pou->rung[k]);
	pou->rung_count = 0;
	return true;
}

void convert_join(struct project *project)
{
	int kept = 0;

	for (int i = 0; i < project->part_count; i++) {
		project->part[i].included = 0;
		if (project->part[i].kind != PART_INCLUDE &&
		    project->part[i].kind != PART_USES)
			project->part[kept++] = project->part[i];
	}
	project->part_count = kept;
	for (int i = 0; i < project->pou_count; i++)
		project->pou[i].included = 0;
}
