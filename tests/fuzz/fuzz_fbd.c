/* SPDX-License-Identifier: MIT
 *
 * fuzz_fbd - reads any bytes as the networks of a function block diagram, checks, translates and runs them. What
 * was read is written, and reads again the same.
 *
 * Bytes that are no ASCII stand for words and signs of networks. An input that begins as a rung file is one.
 */
#include "engine/ladder.h"
#include "engine/model/fbd.h"
#include "engine/model/fbd_graph.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

#define SCANS 3
#define DATA_MAX (2u << 20)
#define PLAIN 0x80 /* bytes from here on are words */

static const char head[] =
	"RUNGBOARD 1\nPROGRAM Main FBD\nVAR\n  A, B, C : BOOL; N, M : INT; R : REAL; P : TIME; T : ARRAY[1..3] OF INT;\n"
	"  Wait : TON; Up : CTU; E : R_TRIG; K : SR;\nEND_VAR\nNETWORK\n";
static const char *const words[] = {
	"\nNETWORK", " OFF", " L1", " L2", " \"title\"", "\n", "\n  ", "\n", " := ", " S= ", " R= ", "A", "B", "C", "N", "M", "R", "T[1]", "T[N]",
	"w1", "w2", "w1", "w2", "AND(", "OR(", "ADD(", "MOVE(", "SEL(", "MUX(", "GT(", "LIMIT(", "Wait(", "Up(", "E(", "K(", ")", ")", ", ",
	", ", "EN := ", "IN := ", "PT := ", "IN1 := ", "ENO => ", "Q => ", "NOT ", " AND ", " OR ", " + ", " > ", "R_EDGE(", "F_EDGE(", "PREVIOUS(",
	"JMP L1", "JMP L2", "RETURN", " IF ", "Wait.Q", "Up.CV", "K.Q1", "TRUE", "7", "-32768", "1.5", "T#5ms", "(* c *)", "// c\n",
	"{ at 3, 4 }", "{", "}", "END_PROGRAM\n", ";", "INT_TO_REAL(", "%QX0.1", "%IX0.2",
};
#define WORDS (sizeof(words) / sizeof(*words))

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

/* malloc'ed. */
static char *spell(const uint8_t *bytes, size_t len, size_t *out_len)
{
	const bool whole = len > 9 && !memcmp(bytes, "RUNGBOARD", 9);
	char *text = malloc(sizeof(head) + len * 16 + 32), *at = text;

	if (!text)
		return NULL;
	if (!whole) {
		memcpy(at, head, sizeof(head) - 1);
		at += sizeof(head) - 1;
	}
	for (size_t i = 0; i < len; i++) {
		const char *word = words[(bytes[i] - PLAIN) % WORDS];

		if (whole || bytes[i] < PLAIN) {
			*at++ = (char)bytes[i];
			continue;
		}
		memcpy(at, word, strlen(word));
		at += strlen(word);
	}
	if (!whole) {
		memcpy(at, "\nEND_PROGRAM\n", 13);
		at += 13;
	}
	*out_len = (size_t)(at - text);
	return text;
}

static void write_twice(struct ladder *ladder)
{
	size_t len, again_len;
	char *text = ladder_write(ladder, &len), *again;
	struct ladder *other = ladder_new();

	fuzz_expect(text && other, "a project that was read can be written");
	fuzz_expect(ladder_load_text(other, "again.rung", text, len), "what was written can be read");
	again = ladder_write(other, &again_len);
	fuzz_expect(again && again_len == len && !memcmp(text, again, len), "the canonical form does not change");
	free(again);
	free(text);
	ladder_free(other);
}

/* Each network as boxes: every pin belongs to its box, every wire begins at an output. */
static void look_at(struct project *project)
{
	for (int p = 0; p < project->pou_count; p++)
		for (int n = 0; project->pou[p].fbd && n < project->pou[p].fbd->count; n++) {
			struct fbd_graph graph;

			if (!fbd_graph_make(project, &project->pou[p], n, &graph))
				continue;
			for (int i = 0; i < graph.pin_count; i++) {
				const int source = graph.pin[i].output ? -1 : fbd_graph_source(&graph, i);

				fuzz_expect(graph.pin[i].box >= 0 && graph.pin[i].box < graph.box_count, "a pin belongs to a box");
				fuzz_expect(source < graph.pin_count && (source < 0 || graph.pin[source].output), "a wire begins at an output");
			}
			fbd_graph_free(&graph);
		}
}

static void run(struct ladder *ladder)
{
	const struct program *program = ladder_program(ladder);
	const size_t size = (image_memory_size(program) + 7) / 8 * 8;
	static struct resource resource;
	void *memory;

	if (size > DATA_MAX)
		return;
	memory = aligned_alloc(8, size);
	fuzz_expect(memory != NULL, "memory");
	resource_init(&resource, program, memory);
	resource_start(&resource);
	for (int i = 0; i < SCANS; i++)
		if (!resource_scan(&resource, 1000000 * (int64_t)i))
			break; /* a loop that does not end */
	free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();
	size_t size = 0;
	char *text = spell(bytes, len, &size);

	fuzz_expect(ladder && text, "memory");
	ladder_watch(ladder, len % 2);
	if (!ladder_load_text(ladder, "fuzz.rung", text, size)) {
		fuzz_expect(ladder_diags(ladder)->errors > 0, "a refused file has an error");
		fuzz_expect(!ladder_program(ladder), "nothing is half loaded");
	} else if (ladder_project(ladder)) {
		const bool good = ladder_build(ladder);

		fuzz_expect(good == (ladder_diags(ladder)->errors == 0), "a build fails just when there is an error");
		look_at(ladder_read_project(ladder));
		write_twice(ladder);
		if (good)
			run(ladder);
	}
	free(text);
	ladder_free(ladder);
	return 0;
}
