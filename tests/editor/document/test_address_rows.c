/* SPDX-License-Identifier: MIT
 *
 * test_address_rows - the memory as rows: states and texts of a small program, and random
 * programs against a count of each bit.
 */
#include "editor-gtk/document/address_rows.h"

#include "tests/editor/opened.h"
#include "tests/tap.h"

static const char PROGRAM[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Speed AT %MW4 : INT;\n"
	"  Over AT %MX4.1 : BOOL;\n  Idle AT %QX0.7 : BOOL;\n"
	"  Lamps AT %QX1.0 : ARRAY[0..9] OF BOOL;\n  Table AT %MW100 : ARRAY[0..99] OF INT;\n"
	"END_VAR\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO Start | [ Speed := Speed + 1 ] | COIL %QX0.0 |\n"
	"RUNG\n  | NO Over | [ %MD200 > 1 ] | COIL %QX0.0 |\n"
	"RUNG\n  | NO Lamps[3] | [ Table[1] > 2 ] | S %QX0.1 |\n"
	"RUNG\n  | NO Start | R %QX0.1 |\nRUNG OFF\n  | NO Start | COIL %QX0.1 |\nEND_PROGRAM\n";

/* The row with this byte; -1: none. */
static int row_of(const struct address_rows *rows, enum iec_area area, uint32_t byte)
{
	for (int i = 0; i < (int)rows->row->len; i++) {
		const struct address_row *row = address_rows_at(rows, i);

		if (row->area == area && row->byte <= byte && byte < row->end)
			return i;
	}
	return -1;
}

static bool is_state(const struct address_rows *rows, const char *address,
		     enum address_state wanted, const char *text)
{
	struct iec_addr addr = { 0 };
	int row, column, table, index;
	char *shown, *name;
	bool good;

	iec_addr_parse(address, strlen(address), &addr);
	row = row_of(rows, addr.area, addr.byte);
	column = addr.bits == 1 ? addr.bit : addr.bits == 8 ? ADDRESS_BYTE : addr.bits == 16 ?
		 ADDRESS_WORD : addr.bits == 32 ? ADDRESS_DOUBLE : ADDRESS_LONG;
	shown = address_cell_text(rows, row, column);
	good = address_state_of(rows, row, column) == wanted && strcmp(shown, text) == 0;
	if (!good)
		printf("# %s: %d %s\n", address, (int)address_state_of(rows, row, column), shown);
	good &= address_cell_goal(rows, row, column, &table, &index, &name) ==
		(wanted != ADDRESS_FREE);
	g_free(name);
	g_free(shown);
	return good;
}

static bool is_row(const struct address_rows *rows, enum iec_area area, uint32_t byte,
		   const char *text, const char *names)
{
	const int row = row_of(rows, area, byte);
	char *shown = address_row_text(rows, row), *of = address_row_names(rows, row);
	const bool good = strcmp(shown, text) == 0 && strcmp(of, names) == 0;

	if (!good)
		printf("# %s | %s\n", shown, of);
	g_free(of);
	g_free(shown);
	return good;
}

static void test_program(void)
{
	LadderDocument *document = opened(PROGRAM);
	struct address_rows *rows = address_rows_new(document);

	CHECK(is_state(rows, "%IX0.0", ADDRESS_USED, "%IX0.0: Start, 3 uses"));
	CHECK(is_state(rows, "%IX0.1", ADDRESS_FREE, "%IX0.1: free"));
	CHECK(is_state(rows, "%MW4", ADDRESS_SEVERAL, "%MW4: Speed, 2 uses"));
	CHECK(is_state(rows, "%MX4.0", ADDRESS_USED, "%MW4: Speed, 2 uses"));
	CHECK(is_state(rows, "%MX4.1", ADDRESS_SEVERAL,
		       "%MW4: Speed, 2 uses\n%MX4.1: Over, 1 use"));
	CHECK(is_state(rows, "%MX5.0", ADDRESS_USED, "%MW4: Speed, 2 uses"));
	CHECK(is_state(rows, "%QX0.7", ADDRESS_UNUSED, "%QX0.7: Idle, 0 uses"));
	CHECK_AS(is_state(rows, "%QX0.0", ADDRESS_TWICE, "%QX0.0: 2 uses, written in 2 places"),
		 "an address written by two coils is reported");
	CHECK_AS(is_state(rows, "%QX0.1", ADDRESS_USED, "%QX0.1: 3 uses"),
		 "S, R and a disabled rung are not two writers");
	CHECK(is_state(rows, "%QX2.1", ADDRESS_USED, "%QX1.0: Lamps, 1 use"));
	CHECK(is_state(rows, "%QX2.2", ADDRESS_FREE, "%QX2.2: free"));
	CHECK(is_state(rows, "%MB5", ADDRESS_FREE, "%MB5: not used in this width"));
	CHECK(is_row(rows, AREA_M, 0, "%MB0 – %MB3", "4 bytes free"));
	CHECK(is_row(rows, AREA_M, 4, "%MB4", "Speed (%MW4), Over (%MX4.1)"));
	CHECK_AS(is_row(rows, AREA_M, 150, "%MB100 – %MB199", "Table (%MW100)"),
		 "a long array is folded");
	CHECK(is_row(rows, AREA_M, 202, "%MB202", "Table (%MW100), %MD200"));
	CHECK(is_row(rows, AREA_M, 8000, "%MB300 – %MB8191", "7892 bytes free"));
	address_rows_free(rows);
	g_object_unref(document);
}

/* An index behind an address leads to the end of its area. */
static void test_index(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nVAR\n  I : INT;\n"
		"  Over AT %MX6.1 : BOOL;\nEND_VAR\n\nPROGRAM Main LD\n"
		"RUNG\n  | NO Over | [ %MW4[I] := I ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	struct address_rows *rows = address_rows_new(document);

	CHECK(is_state(rows, "%MX3.7", ADDRESS_FREE, "%MX0.7: free"));
	CHECK(is_row(rows, AREA_M, 0, "%MB0 – %MB3", "4 bytes free"));
	CHECK(is_state(rows, "%MX4.0", ADDRESS_USED, "%MW4: 1 use"));
	CHECK(is_state(rows, "%MX6.0", ADDRESS_REACHED, "%MX6.0: an index may reach it"));
	CHECK(is_state(rows, "%MX6.1", ADDRESS_USED, "%MX6.1: Over, 1 use\n"
		       "an index may reach it"));
	CHECK(is_state(rows, "%MB6", ADDRESS_FREE, "%MB6: not used in this width"));
	CHECK(is_row(rows, AREA_M, 8000, "%MB7 – %MB8191",
		     "8185 bytes that an index may reach"));
	CHECK_AS(is_state(rows, "%QX0.1", ADDRESS_FREE, "%QX0.1: free"), "another area");
	CHECK(!address_is_reached(rows, row_of(rows, AREA_M, 3)) &&
	      !address_is_reached(rows, row_of(rows, AREA_Q, 0)));
	for (uint32_t byte = 4; byte < 9; byte++)
		CHECK(address_is_reached(rows, row_of(rows, AREA_M, byte)));
	address_rows_free(rows);
	g_object_unref(document);
}

/* ---- against a count of each bit ---- */

static const char *const letters[] = { "I", "Q", "M" };

static void append_address(GRand *random, GString *out)
{
	static const char width[] = "XBWD";
	const char *area = letters[g_rand_int_range(random, 0, 3)];
	const int n = g_rand_int_range(random, 0, 4), byte = g_rand_int_range(random, 0, 40);

	if (n == 0)
		g_string_append_printf(out, "%%%sX%d.%d", area, byte, g_rand_int_range(random, 0, 8));
	else
		g_string_append_printf(out, "%%%s%c%d", area, width[n], byte);
}

static char *random_program(GRand *random)
{
	static const char *const type[] = { ['X'] = "BOOL", ['B'] = "BYTE", ['W'] = "WORD",
					    ['D'] = "DWORD" };
	GString *text = g_string_new("RUNGBOARD 1\n\nVAR\n"), *address = g_string_new(NULL);

	for (int i = 0; i < 12; i++) {
		g_string_truncate(address, 0);
		append_address(random, address);
		g_string_append_printf(text, "  V%d AT %s : %s%s;\n", i, address->str,
			g_rand_int_range(random, 0, 4) ? "" : "ARRAY[0..30] OF ",
			type[(int)address->str[2]]);
	}
	g_string_append(text, "END_VAR\n\nPROGRAM Main LD\n");
	for (int i = 0; i < 15; i++) {
		static const char *const coils[] = { "COIL", "S", "R", "COILNOT" };

		g_string_append(text, g_rand_int_range(random, 0, 6) ? "RUNG\n  | [ " :
				"RUNG OFF\n  | [ ");
		append_address(random, text);
		g_string_append_printf(text, " = V%d ] | %s %%QX%d.%d |\n",
			g_rand_int_range(random, 0, 12), coils[g_rand_int_range(random, 0, 4)],
			g_rand_int_range(random, 0, 3), g_rand_int_range(random, 0, 8));
	}
	g_string_append(text, "END_PROGRAM\n");
	g_string_free(address, TRUE);
	return g_string_free(text, FALSE);
}

/* The state of a bit, counted from the uses. */
static enum address_state count_bit(struct xref *xref, enum iec_area area, uint32_t bit)
{
	const struct xref_target *seen[64];
	int things = 0, uses = 0, coils = 0, writes = 0;

	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];
		const struct iec_addr at = use->target.addr;
		const struct var *var = xref_var(xref->project, &use->target);
		const uint32_t first = at.byte * 8 + at.bit;
		const uint32_t end = first + at.bits * (var && var->array.count ? var->array.count : 1);
		int k = 0;

		if (at.area != area || bit < first || bit >= end)
			continue;
		while (k < things && !xref_same(seen[k], &use->target))
			k++;
		if (k == things && things < 64)
			seen[things++] = &use->target;
		uses += use->kind != XREF_DECLARED;
		coils += use->kind == XREF_COIL && !use->off;
		writes += (use->kind == XREF_WRITTEN || use->kind == XREF_CHANGED) && !use->off;
	}
	return !things ? ADDRESS_FREE : coils > 1 || (coils && writes) ? ADDRESS_TWICE :
	       things > 1 ? ADDRESS_SEVERAL : uses ? ADDRESS_USED : ADDRESS_UNUSED;
}

static int random_faults(guint32 seed)
{
	GRand *random = g_rand_new_with_seed(seed);
	char *text = random_program(random);
	LadderDocument *document = opened(text);
	struct address_rows *rows = address_rows_new(document);
	uint32_t next[AREA_COUNT] = { 0 };
	struct areas areas;
	int bad = 0;

	project_areas(ladder_document_project(document), &areas);
	for (int i = 0; i < (int)rows->row->len; i++) {
		const struct address_row *row = address_rows_at(rows, i);

		bad += row->byte != next[row->area] || row->end <= row->byte;
		next[row->area] = row->end;
		for (int bit = 0; bit < 8; bit++)
			bad += address_state_of(rows, i, bit) !=
			       count_bit(&rows->xref, row->area, row->byte * 8 + (uint32_t)bit);
	}
	for (int i = 0; i < AREA_COUNT; i++)
		bad += next[i] && next[i] != areas.bytes[i];
	if (bad)
		printf("# seed %u: %d\n%s\n", seed, bad, text);
	address_rows_free(rows);
	g_object_unref(document);
	g_free(text);
	g_rand_free(random);
	return bad;
}

int main(void)
{
	int bad = 0;

	test_program();
	test_index();
	for (guint32 seed = 1; seed <= 100 && !bad; seed++)
		bad += random_faults(seed);
	CHECK_AS(bad == 0, "rows cover each area, and each bit has the state that its uses give");
	return tap_done();
}
