# SPDX-License-Identifier: MIT
#
# Refused.pm - programs that `ladder check` must refuse, with a wrong use of a word in each
# rung: "bad-types-FAMILY", a pin of the wrong type; "bad-range-FAMILY", a constant outside
# its type. For tables: all pairs of a pin and a type; pins that are missing, unknown or in
# the wrong direction; elements and operators with each kind of operand. A person reads the
# messages and blesses them.
package Refused;
use strict;
use warnings;
use Values;

sub program {
	my ($title, $more, @rungs) = @_;
	my ($text, $byte) = ("RUNGBOARD 1\nPROJECT \"$title\"\n\nVAR\n", 8);
	my $body = join '', map { "RUNG\n  | $_ |\n" } @rungs;
	for my $type (@Values::types) {
		my $size = $Values::bytes{$type} // 8;
		my $letter = { 1 => 'B', 2 => 'W', 4 => 'D', 8 => 'L' }->{$size};
		my $at = sub { $type eq 'STRING' ? '' : $type eq 'BOOL' ? " AT %$_[0]X$byte.0" :
			" AT %$_[0]$letter$byte" };
		for my $name (grep { $body =~ /\b$_\b/ } "x_$type", "o_$type") {
			$text .= "  $name" . $at->($name =~ /^x/ ? 'I' : 'Q') . " : $type;\n";
		}
		$byte += 8;
	}
	return $text . "${more}END_VAR\n\nPROGRAM Main LD\n${body}END_PROGRAM\n";
}

# The types of a function's pins, as names of variables.
sub usual {
	my ($pin) = @_;
	return (grep { $pin->{takes}{$_} } qw(INT REAL TIME WORD), @Values::types)[0];
}

# All words: the beginning of their rung, their inputs (name and types), their outputs.
sub of_function {
	my ($row) = @_;
	my ($shared) = grep { !$_->{own} } @{$row->{pins}};
	my $out = $row->{result} =~ /^RESULT_(?:SAME|GATE)$/ ? usual($shared) :
		$row->{result} =~ /^IEC_(\w+)$/ ? $1 :
		$shared->{takes}{INT} ? 'WORD' : 'INT';
	$out = 'WORD' if $row->{word} eq 'TO_BCD';
	return { begin => sub { $row->{word} }, inputs => $row->{pins}, declared => sub { '' },
		outputs => [{ name => 'OUT', takes => { $out => 1 } }], most => $row->{most} };
}

sub of_block {
	my ($word) = @_;
	my @pins = map { { name => $_->{pin}, takes => { $_->{type} => 1 },
		default => $_->{default}, direction => $_->{direction} } } @{$word->{pins}};
	my @in = grep { $_->{direction} eq 'in' } @pins;
	# The first pin has the power of the row.
	shift @in if $in[0]{takes}{BOOL};
	my $count = 0;
	return { begin => sub { $count++; "$word->{word} b$count" . "_$word->{word}" },
		inputs => \@in, block => 1, outputs => [grep { $_->{direction} eq 'out' } @pins],
		declared => sub { join '', map { "  b${_}_$word->{word} : $word->{word};\n" } 1 .. $count } };
}

sub call {
	my ($word, $pins, @more) = @_;
	return join ' ', $word->{begin}->(), (map { "$_->[0]{name}:=$_->[1]" } @$pins), @more;
}

sub good {
	my ($word) = @_;
	return map { [$_, 'x_' . usual($_)] } @{$word->{inputs}};
}

# A type that a pin does not accept, as different as possible.
sub wrong {
	my ($pin) = @_;
	return (grep { !$pin->{takes}{$_} } qw(STRING BOOL LREAL DATE TIME), @Values::types)[0];
}

sub wrong_types {
	my ($word) = @_;
	my @rungs;
	my @good = good($word);
	for my $i (0 .. $#good) {
		my $wrong = wrong($good[$i][0]) // next;
		push @rungs, call($word, [map { $_ == $i ? [$good[$_][0], "x_$wrong"] : $good[$_] }
			0 .. $#good]);
	}
	for my $out (@{$word->{outputs}}) {
		push @rungs, call($word, \@good, "$out->{name}=>o_" . wrong($out));
	}
	return @rungs;
}

# [the error, the rung]
sub wrong_pins {
	my ($word) = @_;
	my @good = good($word);
	my @rungs;
	for my $i (0 .. $#good) {
		push @rungs, ["without $good[$i][0]{name}",
			call($word, [@good[grep { $_ != $i } 0 .. $#good]])];
	}
	push @rungs, ['a pin that is not there', call($word, \@good, 'NO_PIN:=x_INT')];
	push @rungs, ['an input given twice', call($word, [@good, $good[0]])] if @good;
	push @rungs, map { ["a value for $_->{name}", call($word, \@good, "$_->{name}:=x_" .
		(sort keys %{$_->{takes}})[0])] } @{$word->{outputs}};
	push @rungs, map { ["$_->[0]{name} as an output", call($word, [], "$_->[0]{name}=>o_" .
		usual($_->[0]))] } @good;
	push @rungs, map { ["$_->{name} into an input", call($word, \@good, "$_->{name}=>x_" .
		(sort keys %{$_->{takes}})[0])] } grep { !$_->{takes}{STRING} } @{$word->{outputs}};
	push @rungs, ['17 inputs', call($word, [map { [{ name => $good[0][0]{name} =~
		s/\d*$/$_/r }, $good[0][1]] } 1 .. 17])] if ($word->{most} // '') eq 'LIMIT_FN_INPUTS';
	return @rungs;
}

sub wrong_range {
	my ($word) = @_;
	my @good = good($word);
	return map { my $i = $_;
		call($word, [map { $_ == $i ? [$good[$_][0], $Values::beyond{usual($good[$_][0])}] :
			$good[$_] } 0 .. $#good]) } 0 .. $#good;
}

# The texts of main.rung of a family, for each kind.
sub family {
	my ($family, @words) = @_;
	my %made;
	my %kinds = (types => ['A wrong type at each pin', \&wrong_types],
		range => ['Constants beyond the range of their type', \&wrong_range]);
	for my $kind (sort keys %kinds) {
		my ($title, $make) = @{$kinds{$kind}};
		# Each family numbers its instances from the start.
		my @fresh = map { $_->() } @words;
		my @rungs = map { $make->($_) } @fresh;
		$made{$kind} = program("$family: $title", join('', map { $_->{declared}->() } @fresh),
			@rungs) if @rungs;
	}
	return %made;
}

# Operands of all kinds, correct for some words and wrong for others.
my @operands = ('', qw(x_BOOL o_BOOL x_INT o_INT x_STRING Table Table[9] Table[x_BOOL] Group
	Timer Fixed 1 TRUE 'text'), 'T#1s', qw(Nowhere TON ADD Main Sub Here %IX511.0 %QB0 SYS_FIRST_SCAN),
	'x_BOOL x_BOOL');
my $declared = "  Table : ARRAY[1..3] OF BOOL;\n  Group : Pair;\n  Timer : TON;\n" .
	"END_VAR\n\nVAR CONSTANT\n  Fixed : BOOL := TRUE;\n";
my $around = "TYPE\n  Pair : STRUCT\n    A : BOOL;\n    B : BOOL;\n  END_STRUCT;\nEND_TYPE\n\n";
my $sub = "\nSUBROUTINE Sub LD\nRUNG\n  | COIL Table[1] |\nEND_SUBROUTINE\n";

# An element or operator with each operand, each in its own program, because an error of
# reading ends the check before types are checked. Pairs of operand and text.
sub with_operands {
	my ($word) = @_;
	return map { [$_ eq '' ? '(none)' : $_, $word->{kind} eq 'element' ?
		in_ladder($word->{word}, $_) : in_list($word->{word}, $_)] } @operands;
}

sub with_rung {
	my ($rung) = @_;
	my $text = program('An operand of each kind', $declared, $rung);
	$text =~ s/^VAR\n/${around}VAR\n/m;
	return $text . $sub;
}

sub in_ladder {
	my ($word, $operand) = @_;
	my $cell = $operand eq '' ? $word : "$word $operand";
	$cell = "[ $operand ] | COIL o_BOOL" if $word eq '[ ]';
	$cell = "[ $operand := $operand ]" if $word eq '[:=]';
	$cell .= ' | COIL o_BOOL' if $word =~ /^(?:---|N[OC]|[PN]|NOT)$/;
	$cell = "TON Timer | COIL o_BOOL |\n  | .$operand" if $word eq '.';
	$cell = "FOR $operand := 1 TO 3 |\nRUNG\n  | NEXT" if $word eq 'FOR';
	return with_rung($cell) =~ s/RUNG\n/RUNG Here\n/r;
}

sub in_list {
	my ($word, $operand) = @_;
	my $list = "  LD x_BOOL\n  $word $operand\n  ST o_BOOL\nHere:\n  LD x_BOOL\n  ST o_BOOL\n";
	return with_rung("x_BOOL o_BOOL $operand") =~
		s/PROGRAM Main LD\n.*?END_PROGRAM/PROGRAM Main IL\n${list}END_PROGRAM/sr;
}

# All pairs of a pin and a type, also correct ones: [rung of the word, pin, type].
sub all_types {
	my ($word) = @_;
	my @good = good($word);
	my @made;
	for my $i (0 .. $#good) {
		push @made, map { my $type = $_; [call($word, [map { $_ == $i ?
			[$good[$_][0], "x_$type"] : $good[$_] } 0 .. $#good]), $good[$i][0]{name}, $type]
		} @Values::types;
	}
	for my $out (@{$word->{outputs}}) {
		push @made, map { [call($word, \@good, "$out->{name}=>o_$_"), $out->{name}, $_]
		} @Values::types;
	}
	return @made;
}

1;
