/* SPDX-License-Identifier: MIT
 *
 * random_print - a random program as text, with just the declarations it uses.
 */
#include "tests/walker/random.h"

#include <stdio.h>
#include <string.h>

struct page {
	char *out;
	size_t size, used;
};

static void add_part(struct page *page, const char *text, size_t len)
{
	if (page->used + len + 1 > page->size)
		len = page->size - page->used - 1;
	memcpy(page->out + page->used, text, len);
	page->used += len;
	page->out[page->used] = '\0';
}

static void add(struct page *page, const char *text)
{
	add_part(page, text, strlen(text));
}

/* The statements of EXECUTE boxes, which stand behind the first line of their text. */
static void print_boxes(const struct random_rung *rung, struct page *page)
{
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			const struct random_cell *cell = &rung->cell[row][col];
			const char *lines = cell->kind == RANDOM_WIRE ? NULL : strchr(cell->text, '\n');

			if (!lines)
				continue;
			add(page, "  EXECUTE:");
			add(page, lines);
			add(page, "\n  END_EXECUTE\n");
		}
}

static bool is_aimed_at(const struct random_program *program, int label)
{
	char text[24];

	snprintf(text, sizeof(text), "JMP L%d", label);
	for (int i = 0; i < program->rungs; i++)
		for (int row = 0; row < RANDOM_ROWS; row++)
			for (int col = 0; col < RANDOM_COLS; col++)
				if (strcmp(program->rung[i].cell[row][col].text,
					   text) == 0)
					return true;
	return false;
}

static void print_rung(const struct random_program *program,
		       const struct random_rung *rung, struct page *page)
{
	bool aimed = rung->label && is_aimed_at(program, rung->label);
	char text[24];

	add(page, rung->off && !aimed ? "RUNG OFF" : "RUNG");
	if (aimed) {
		snprintf(text, sizeof(text), " L%d", rung->label);
		add(page, text);
	}
	add(page, "\n");
	for (int row = 0; row < rung->rows; row++) {
		add(page, "  |");
		for (int col = 0; col < rung->cols; col++) {
			const struct random_cell *cell = &rung->cell[row][col];

			add(page, " ");
			if (cell->kind == RANDOM_WIRE)
				add(page, "---");
			else
				add_part(page, cell->text, strcspn(cell->text, "\n"));
			add(page, cell->link ? " ^|" : " |");
		}
		add(page, "\n");
	}
	print_boxes(rung, page);
}

/* Whether it calls or reads something of the program's own. */
static bool is_own(const struct random_program *program, const char *body)
{
	return program->rung[program->rungs - 1].pou > RANDOM_OTHER ||
	       strstr(body, "inner_") || strstr(body, "outer_") || strstr(body, "Reckon ");
}

static void print_own(const struct random_program *program, struct page *page)
{
	for (int pou = RANDOM_INNER; pou < RANDOM_POUS; pou++) {
		add(page, random_own_head(pou));
		for (int i = 0; i < program->rungs; i++)
			if (program->rung[i].pou == pou)
				print_rung(program, &program->rung[i], page);
		add(page, random_own_tail(pou));
	}
}

static void print_areas(const struct random_program *program, struct page *page)
{
	static const char *const letters[RANDOM_AREAS] = { "I", "Q", "M", "V", "XAQ" };
	char line[64];

	if (!program->sized)
		return;
	add(page, "CONFIGURATION Sizes\n");
	for (int i = 0; i < RANDOM_AREAS; i++) {
		snprintf(line, sizeof(line), "  AREA %s %u;\n", letters[i],
			 (unsigned)program->bytes[i]);
		add(page, line);
	}
	add(page, "END_CONFIGURATION\n");
}

size_t random_print(const struct random_program *program, char *out,
		    size_t size)
{
	const char *kind = program->routine ? "SUBROUTINE" : "PROGRAM";
	static const char vars[] = "VAR\n  bool_b : BOOL;\n  int_b : INT;\nEND_VAR\n";
	static char body[80 * 1024];
	struct page page = { body, sizeof(body), 0 };
	struct page whole = { out, size, 0 };
	char line[64];
	int pou = RANDOM_MAIN;

	add(&page, "PROGRAM Main LD\n");
	for (int i = 0; i < program->rungs; i++) {
		int next = program->rung[i].pou;

		if (next != pou && next == RANDOM_OTHER) {
			snprintf(line, sizeof(line), "END_PROGRAM\n%s Other LD\n", kind);
			add(&page, line);
			add(&page, vars);
			pou = next;
		}
		if (next <= RANDOM_OTHER)
			print_rung(program, &program->rung[i], &page);
	}
	snprintf(line, sizeof(line), "END_%s\n", pou ? kind : "PROGRAM");
	add(&page, line);
	if (is_own(program, body))
		print_own(program, &page);
	add(&whole, "RUNGBOARD 1\n");
	add(&whole, random_types(body));
	whole.used += random_declare(body, out + whole.used, size - whole.used);
	print_areas(program, &whole);
	add(&whole, body);
	return whole.used;
}
