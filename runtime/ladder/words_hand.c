/* SPDX-License-Identifier: MIT
 *
 * words_hand - examples that no rule can make from a row: words of the ladder that
 * want something around them, and the operators of the list.
 *
 * Bodies of POUs, as words_example.c puts them into a file; in any form, it makes them
 * canonical.
 */
#include "ladder/words.h"

static const struct {
	enum word word;
	struct words_hand hand;
} of_word[] = {
	{ ELEM_WIRE, { "", "| NO Input | --- | COIL Output |\n", "" } },
	{ ELEM_JUMP, { "Hand AT %IX0.1 : BOOL;\n",
		"| NO Hand | JMP Behind |\nRUNG\n| NO Input | COIL Output |\n"
		"RUNG Behind\n| NO Hand | COIL %QX0.1 |\n", "" } },
	{ ELEM_CALL, { "", "| P Input | CALL Turn | COIL Output |\n",
		"\nSUBROUTINE Turn LD\nRUNG\n| NC %QX0.1 | COIL %QX0.1 |\n"
		"END_SUBROUTINE\n" } },
	{ ELEM_FOR, { "I : INT;\nSum : INT;\n",
		"| NO Input | FOR I := 1 TO 4 |\nRUNG\n| [ Sum := Sum + I ] |\n"
		"RUNG\n| NEXT |\n", "" } },
	{ ELEM_NEXT, { "I : INT;\nSum : INT;\n",
		"| NO Input | FOR I := 1 TO 4 |\nRUNG\n| [ Sum := Sum + I ] |\n"
		"RUNG\n| NEXT |\n", "" } },
	{ ELEM_COMPARE, { "Level AT %IW2 : INT;\n",
		"| NO Input | [ Level > 20 AND Level < 80 ] | COIL Output |\n", "" } },
	{ ELEM_ASSIGN, { "Level : INT;\n",
		"| P Input | [ Level := Level * 2 + 1 ] |\n", "" } },
	{ ELEM_PIN, { "Box : CTU;\n",
		"| NO Input  | CTU Box PV:=3 | COIL Output |\n"
		"| NO %IX0.1 | .R           |\n", "" } },
	{ FN_INC, { "Count : INT;\n",
		"| P Input | INC IN:=Count OUT=>Count | COIL Output |\n", "" } },
	{ FN_DEC, { "Count : INT := 10;\n",
		"| P Input | DEC IN:=Count OUT=>Count | COIL Output |\n", "" } },
#ifndef RUNGBOARD_CORE_WORDS
	{ FN_CONVERT_NS, { "Value : TIME := T#1s500ms;\nResult AT %ML0 : LINT;\n",
		"| NO Input | CONVERT_NS IN:=Value OUT=>Result | COIL Output |\n",
		"" } },
#endif
};

static const struct words_hand of_op[OP_COUNT] = {
	[OP_LD]  = { "", "LD Input\nST Output\n", "" },
	[OP_ST]  = { "", "LD Input\nST Output\nSTN %QX0.1\n", "" },
	[OP_S]   = { "", "LD Input\nS Output\n", "" },
	[OP_R]   = { "", "LD Input\nR Output\n", "" },
	[OP_AND] = { "", "LD Input\nANDN %IX0.1\nST Output\n", "" },
	[OP_OR]  = { "", "LD Input\nOR( %IX0.1\nAND %IX0.2\n)\nST Output\n", "" },
	[OP_XOR] = { "", "LD Input\nXOR %IX0.1\nST Output\n", "" },
	[OP_NOT] = { "", "LD Input\nAND %IX0.1\nNOT\nST Output\n", "" },
	[OP_JMP] = { "", "LD Input\nJMPC Behind\nLD %IX0.1\nST Output\n"
			 "Behind: LD Input\nST %QX0.1\n", "" },
	[OP_CAL] = { "Box : TON;\n", "CAL Box(IN := Input, PT := T#2s)\nLD Box.Q\n"
				     "ST Output\n", "" },
	[OP_RET] = { "", "LD %IX0.1\nRETC\nLD Input\nST Output\n", "" },
	[OP_STP] = { "", "LD Input\nST Output\nLD %IX0.1\nSTPC\n", "" },
};

const struct words_hand *words_hand(const struct words_entry *entry, bool list)
{
	if (entry->kind == WORDS_OPERATOR)
		return &of_op[entry->number];
	for (size_t i = 0; !list && i < sizeof(of_word) / sizeof(of_word[0]); i++)
		if (entry->row == word_row(of_word[i].word))
			return &of_word[i].hand;
	return NULL;
}
