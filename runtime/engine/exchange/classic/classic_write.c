/* SPDX-License-Identifier: MIT
 *
 * classic_write - writes the members of a ClassicLadder project, in the order of
 * ClassicLadder.
 */
#include "engine/exchange/classic/classic_write.h"

#include <string.h>

struct writer {
	const struct classic_project *project;
	const struct sink *sink;
	bool upstream;
};

int classic_columns(enum classic_dialect dialect)
{
	return dialect == CLASSIC_UPSTREAM ? CLASSIC_COLUMNS : 10;
}

int classic_rows(enum classic_dialect dialect)
{
	return dialect == CLASSIC_UPSTREAM ? CLASSIC_ROWS : 6;
}

int classic_cut(const char *text, int most)
{
	int len = (int)strlen(text);

	if (len <= most)
		return len;
	for (len = most; len && ((unsigned char)text[len] & 0xC0) == 0x80;)
		len--;
	return len;
}

/* A field, without characters that would end it or the line. */
static void put_field(struct writer *w, const char *text, int most, bool comma)
{
	int len = classic_cut(text, most);

	for (int i = 0; i < len; i++) {
		char c = text[i];

		if ((unsigned char)c < ' ')
			c = ' ';
		else if (c == ',' && !comma)
			c = ';';
		sink_write(w->sink, &c, 1);
	}
}

static void begin(struct writer *w, const char *member)
{
	sink_text(w->sink, "_FILE-");
	sink_text(w->sink, member);
	sink_text(w->sink, "\n");
}

static void end(struct writer *w, const char *member)
{
	sink_text(w->sink, "_/FILE-");
	sink_text(w->sink, member);
	sink_text(w->sink, "\n");
}

/* The text of a member that an import kept; NULL: none. */
static const char *kept(const struct writer *w, const char *member)
{
	for (int i = 0; i < w->project->members; i++)
		if (!strcmp(w->project->member[i].name, member))
			return w->project->member[i].text;
	return NULL;
}

static void put_member(struct writer *w, const char *member, const char *text)
{
	const char *own = kept(w, member);

	begin(w, member);
	sink_text(w->sink, own ? own : text);
	end(w, member);
}

/* ---- settings ---- */

static bool is_about(const char *key)
{
	return !strncmp(key, "PROJECT_", 8) || !strncmp(key, "PARAM_", 6) ||
	       !strcmp(key, "CREA_DATE") || !strcmp(key, "MODIF_DATE");
}

static void write_settings(struct writer *w, const char *member, bool about)
{
	begin(w, member);
	for (int i = 0; i < w->project->settings; i++) {
		const struct classic_setting *setting = &w->project->setting[i];

		if (is_about(setting->key) != about)
			continue;
		sink_text(w->sink, setting->key);
		sink_text(w->sink, "=");
		put_field(w, setting->value, strcmp(setting->key, "PARAM_COMMENT") ?
			  CLASSIC_COMMENT : CLASSIC_ABOUT, true);
		sink_text(w->sink, "\n");
	}
	end(w, member);
}

/* ---- blocks ---- */

static void put_values(struct writer *w, const struct classic_block *block,
		       const char *values)
{
	for (int i = 0; values[i]; i++)
		sink_printf(w->sink, "%s%d", i ? "," : "",
			    values[i] == 'b' ? block->base :
			    values[i] == 'p' ? block->preset : block->mode);
	sink_text(w->sink, "\n");
}

/* Upstream has a number on each line, LinuxCNC a line for each number from 0. */
static void write_blocks(struct writer *w, const char *member,
			 const struct classic_blocks *blocks, const char *letters,
			 const char *values)
{
	const struct classic_block none = { .base = 1 };
	int last = blocks->count ? blocks->block[blocks->count - 1].number : 0;

	begin(w, member);
	if (w->upstream) {
		sink_printf(w->sink, "#VER=%s\n", *letters == 'R' ? "1.0" : "2.0");
		for (int i = 0; i < blocks->count; i++) {
			sink_printf(w->sink, "%s%d,", letters, blocks->block[i].number);
			put_values(w, &blocks->block[i], values);
		}
	} else {
		for (int i = 0, k = 0; i <= last || i < 10; i++) {
			bool is = k < blocks->count && blocks->block[k].number == i;

			put_values(w, is ? &blocks->block[k++] : &none, values);
		}
	}
	end(w, member);
}

static void write_expressions(struct writer *w)
{
	begin(w, "arithmetic_expressions.csv");
	sink_text(w->sink, "#VER=2.0\n");
	for (int i = 0; i < w->project->expressions; i++)
		sink_printf(w->sink, "%04d,%s\n", w->project->expression[i].number,
			    w->project->expression[i].text);
	end(w, "arithmetic_expressions.csv");
}

/* ---- rungs ---- */

static void put_variable(struct writer *w, const struct classic_variable *variable,
			 char slash)
{
	sink_printf(w->sink, "%d%c%d", variable->type, slash, variable->number);
	if (variable->index_type >= 0 && variable->type >= 0)
		sink_printf(w->sink, "[%d/%d]", variable->index_type,
			    variable->index_number);
}

static void put_row(struct writer *w, const struct classic_cell *cell, char slash)
{
	for (int x = 0; x < classic_columns(w->project->dialect); x++) {
		sink_printf(w->sink, "%s%d-%d-", x ? " , " : "", cell[x].element,
			    cell[x].top);
		put_variable(w, &cell[x].variable, slash);
	}
	sink_text(w->sink, "\n");
}

static void put_head(struct writer *w, const struct classic_rung *rung)
{
	bool is_long = w->upstream && strlen(rung->comment) > CLASSIC_COMMENT;

	sink_text(w->sink, "#LABEL=");
	put_field(w, rung->label, CLASSIC_LABEL, true);
	sink_text(w->sink, is_long ? "\n#COMMENT_LONG=" : "\n#COMMENT=");
	put_field(w, rung->comment, is_long ? CLASSIC_COMMENT_LONG : CLASSIC_COMMENT, true);
	sink_text(w->sink, "\n");
}

static void write_rung(struct writer *w, const struct classic_rung *rung)
{
	int rows = classic_rows(w->project->dialect);

	sink_printf(w->sink, "_FILE-rung_%d.csv\n#VER=%s\n", rung->number,
		    w->upstream ? "3.0" : "2.0");
	put_head(w, rung);
	sink_printf(w->sink, "#PREVRUNG=%d\n#NEXTRUNG=%d\n", rung->previous, rung->next);
	if (w->upstream)
		sink_printf(w->sink, "#NBRLINES=%d\n", rows);
	for (int y = 0; y < rows; y++)
		put_row(w, rung->cell[y], '/');
	sink_printf(w->sink, "_/FILE-rung_%d.csv\n", rung->number);
}

/* ---- sections, pages, symbols ---- */

static void write_sections(struct writer *w)
{
	const struct classic_project *project = w->project;

	begin(w, "sections.csv");
	sink_text(w->sink, "#VER=1.0\n");
	for (int i = 0; i < project->sections; i++) {
		sink_printf(w->sink, "#NAME%03d=", project->section[i].number);
		put_field(w, project->section[i].name, CLASSIC_SECTION_NAME, true);
		sink_text(w->sink, "\n");
	}
	for (int i = 0; i < project->sections; i++) {
		const struct classic_section *section = &project->section[i];

		sink_printf(w->sink, "%03d,%d,%d,%d,%d,%d\n", section->number,
			    section->sequential, section->subroutine, section->first,
			    section->last, section->page);
	}
	end(w, "sections.csv");
}

static void put_links(struct writer *w, const int *list, int count)
{
	for (int i = 0; i < CLASSIC_LINKS; i++)
		sink_printf(w->sink, ",%d", i < count ? list[i] : -1);
}

static void write_pages(struct writer *w)
{
	const struct classic_project *project = w->project;

	begin(w, "sequential.csv");
	sink_text(w->sink, "#VER=1.0\n");
	if (kept(w, "sequential.csv"))
		sink_text(w->sink, kept(w, "sequential.csv"));
	for (int i = 0; i < project->steps; i++) {
		const struct classic_step *step = &project->step[i];

		sink_printf(w->sink, "S%d,%d,%d,%d,%d,%d\n", step->index, step->initial,
			    step->number, step->page, step->x, step->y);
	}
	for (int i = 0; i < project->transitions; i++) {
		const struct classic_transition *t = &project->transition[i];

		sink_printf(w->sink, "T%d", t->index);
		put_links(w, t->activate, t->activates);
		put_links(w, t->deactivate, t->deactivates);
		put_links(w, NULL, 0);
		put_links(w, NULL, 0);
		sink_printf(w->sink, ",%d,%d,%d\nC%d,0,", t->page, t->x, t->y, t->index);
		put_variable(w, &t->condition, '/');
		sink_text(w->sink, "\n");
	}
	for (int i = 0; i < project->notes; i++) {
		const struct classic_note *note = &project->note[i];

		sink_printf(w->sink, "N%d,%d,%d,%d,", i, note->page, note->x, note->y);
		put_field(w, note->text, CLASSIC_NOTE, false);
		sink_text(w->sink, "\n");
	}
	end(w, "sequential.csv");
}

static void write_symbols(struct writer *w)
{
	begin(w, "symbols.csv");
	sink_text(w->sink, "#VER=1.0\n");
	for (int i = 0; i < w->project->symbols; i++) {
		const struct classic_symbol *symbol = &w->project->symbol[i];

		sink_printf(w->sink, "%s,", symbol->variable);
		put_field(w, symbol->name, CLASSIC_SYMBOL, false);
		sink_text(w->sink, ",");
		put_field(w, symbol->comment, w->upstream ? CLASSIC_COMMENT :
			  CLASSIC_SYMBOL_COMMENT, false);
		sink_text(w->sink, "\n");
	}
	end(w, "symbols.csv");
}

static void write_io(struct writer *w)
{
	begin(w, "ioconf.csv");
	sink_text(w->sink, "#VER=1.0\n");
	for (int i = 0; w->upstream && i < w->project->ios; i++) {
		const struct classic_io *io = &w->project->io[i];

		sink_printf(w->sink, "%d,%d,%d,%d,%d,%d,%d,%d\n", io->output, io->first,
			    io->device, io->sub_device, io->channel, io->count,
			    io->inverted, io->setup);
	}
	end(w, "ioconf.csv");
}

/* Members that an export has nothing for: a member must not be empty. */
static void write_rest(struct writer *w)
{
	put_member(w, "com_params.txt", w->upstream ? "MODBUS_ELEMENT_OFFSET=0\n" :
		   "MODBUS_ELEMENT_OFFSET=0\nMODBUS_MAP_COIL_READ=0\n"
		   "MODBUS_MAP_COIL_WRITE=0\nMODBUS_MAP_INPUT=0\nMODBUS_MAP_HOLDING=0\n"
		   "MODBUS_MAP_REGISTER_READ=0\nMODBUS_MAP_REGISTER_WRITE=0\n");
	put_member(w, "modbusioconf.csv", w->upstream ? "#VER=2.0\n" : "#VER=1.0\n");
	if (!w->upstream)
		return;
	put_member(w, "config_events.csv", "#VER=1.0\n");
	put_member(w, "modem_config.txt", "MODEM_USED=0\n");
	put_member(w, "remote_alarms.txt", "GLOBAL_ENABLED=0\n");
	put_member(w, "spy_vars.csv", "0,0,0,0,0,0,0,0,0,0\n0,1,2,3,4,5,6,7,8,9\n0,0,0\n"
		   "0,0,0,0,0,0,0,0,0,0\n");
}

/* ---- all of it ---- */

static int last_row(const struct classic_rung *rung)
{
	for (int y = CLASSIC_ROWS - 1; y > 0; y--)
		for (int x = 0; x < CLASSIC_COLUMNS; x++)
			if (rung->cell[y][x].element || rung->cell[y][x].top)
				return y;
	return 0;
}

static void write_numeric(struct writer *w)
{
	const struct classic_blocks *timer = &w->project->timer;
	const struct classic_block none = { .base = 1 };

	for (int i = 0; i < w->project->rungs; i++) {
		const struct classic_rung *rung = w->project->rung[i];

		sink_text(w->sink, ";Rung:\n");
		put_head(w, rung);
		for (int y = 0; y <= last_row(rung); y++)
			put_row(w, rung->cell[y], '-');
	}
	if (!timer->count)
		return;
	sink_text(w->sink, ";Timers:\n;Base,Preset\n");
	for (int i = 0, k = 0; k < timer->count; i++)
		put_values(w, timer->block[k].number == i ? &timer->block[k++] : &none,
			   "bp");
}

void classic_write(const struct classic_project *project, const struct sink *sink)
{
	struct writer w = { project, sink, project->dialect == CLASSIC_UPSTREAM };

	if (project->dialect == CLASSIC_NUMERIC) {
		write_numeric(&w);
		return;
	}
	sink_text(sink, "_FILES_CLASSICLADDER\n");
	if (w.upstream)
		write_settings(&w, "project_infos.txt", true);
	write_settings(&w, "general.txt", false);
	write_blocks(&w, "timers.csv", &project->timer, "T", "bp");
	write_blocks(&w, "monostables.csv", &project->monostable, "M", "bp");
	write_blocks(&w, "counters.csv", &project->counter, "C", "p");
	write_blocks(&w, "timers_iec.csv", &project->iec_timer, "TM", "bpm");
	if (w.upstream)
		write_blocks(&w, "registers.csv", &project->reg, "R", "m");
	write_expressions(&w);
	for (int i = 0; i < project->rungs; i++)
		write_rung(&w, project->rung[i]);
	write_sections(&w);
	write_pages(&w);
	write_symbols(&w);
	write_io(&w);
	write_rest(&w);
	sink_text(sink, "_/FILES_CLASSICLADDER\n");
}
