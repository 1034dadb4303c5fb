#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# letters.pl - writes letters.def from the Unicode Character Database that perl brings:
# `perl runtime/engine/base/letters.pl > runtime/engine/base/letters.def`.
#
# The facts stand in DerivedCoreProperties.txt (XID_Continue), CaseFolding.txt (status C and
# S) and UnicodeData.txt (canonical decompositions, combining classes).
use strict;
use warnings;
use Unicode::Normalize qw(getCombinClass getCanon);
use Unicode::UCD qw(prop_invlist prop_invmap);

my $version = Unicode::UCD::UnicodeVersion();

# Prints numbers in lines of at most 95 columns.
sub rows {
	my (@items) = @_;
	my $line = "\t";
	for my $item (@items) {
		if (length($line) + length($item) + 2 > 92) {
			$line =~ s/ $//;
			print "$line\n";
			$line = "\t";
		}
		$line .= "$item, ";
	}
	$line =~ s/ $//;
	print "$line\n" if $line ne "\t";
}

# The code points at which the answer of a property changes; unassigned ones go with those
# before them.
sub changes {
	my ($property) = @_;
	my @is = prop_invlist($property);
	my @assigned = prop_invlist('Assigned');
	my (%flip, @out);
	my $at = sub { my ($list, $code) = @_;
		my ($from, $to) = (0, scalar @$list);
		while ($from < $to) {
			my $middle = int(($from + $to) / 2);
			if ($list->[$middle] <= $code) { $from = $middle + 1 } else { $to = $middle }
		}
		return $from % 2;
	};
	my $now = 0;
	for my $code (sort { $a <=> $b } keys %{{ map { $_ => 1 } @is, @assigned }}) {
		next if $code < 0x80 || $code > 0x10ffff || !$at->(\@assigned, $code);
		my $answer = $at->(\@is, $code);
		push @out, $code if $answer != $now;
		$now = $answer;
	}
	return @out;
}

my (@folds, @low, @high, @marks, @runs, @ones);
my $fold = sub { my ($from, $to) = @_;
	my $last = $folds[-1];
	my $delta = $to - $from;
	if ($last && $last->{delta} == $delta) {
		my $step = $from - $last->{last};
		if (($last->{step} == 0 && $step <= 2) || $step == $last->{step}) {
			@$last{'step', 'last'} = ($step, $from);
			return;
		}
	}
	push @folds, { first => $from, last => $from, delta => $delta, step => 0 };
};
my ($list, $map, undef, $missing) = prop_invmap('Simple_Case_Folding');
for my $i (0 .. $#$list) {
	next if $map->[$i] == 0;
	my $end = $i < $#$list ? $list->[$i + 1] : 0x110000;
	$fold->($_, $map->[$i] + $_ - $list->[$i]) for $list->[$i] .. $end - 1;
}
my %canonical; # each code point with a canonical decomposition into one or two
($list, $map) = prop_invmap('Decomposition_Mapping');
my ($types, $type) = prop_invmap('Decomposition_Type');
my %is_canonical;
for my $i (grep { $type->[$_] eq 'Canonical' } 0 .. $#$types) {
	my $end = $i < $#$types ? $types->[$i + 1] : 0x110000;
	$is_canonical{$_} = 1 for $types->[$i] .. $end - 1;
}
for my $i (grep { ref $map->[$_] || $map->[$_] !~ /^(?:0|<)/ } 0 .. $#$list) {
	my $end = $i < $#$list ? $list->[$i + 1] : 0x110000;
	for my $code (grep { $is_canonical{$_} } $list->[$i] .. $end - 1) {
		$canonical{$code} = ref $map->[$i] ? $map->[$i] : [$map->[$i] + $code - $list->[$i]];
	}
}
for my $code (0xc0 .. 0x2ffff) {
	next if $code >= 0xac00 && $code <= 0xdfff; # syllables of Hangul are computed
	my $class = getCombinClass($code);
	if ($class && @marks && $marks[-1][0] + $marks[-1][1] == $code - 1 && $marks[-1][1] < 63 &&
	    $marks[-1][2] == $class) {
		$marks[-1][1]++;
	} elsif ($class) {
		push @marks, [$code, 0, $class];
	}
	next if !$canonical{$code};
	my ($first, $second) = (@{$canonical{$code}}, 0);
	die sprintf "%x: its second part has parts", $code
		if $second && defined getCanon($second);
	if (!$second) {
		if (@runs && $runs[-1][0] + $runs[-1][1] == $code) { $runs[-1][1]++ }
		else { push @runs, [$code, 1] }
		push @ones, $first;
		next;
	}
	push @{$code < 0x10000 && $first < 0x10000 ? \@low : \@high}, [$code, $first, $second];
}
die 'letters beyond U+2FFFF' if grep { defined getCanon($_) || getCombinClass($_) } 0x30000 .. 0x323af;

my @letters = changes('XID_Continue');
print <<HEAD;
/* SPDX-License-Identifier: MIT
 *
 * letters.def - characters of names, from the Unicode Character Database $version. letters.pl writes it.
 *
 * LETTERS_LOW, LETTERS_HIGH: XID_Continue. At each code point of the list the answer changes,
 * from no on. Code points that Unicode has not assigned have the answer of those before them.
 * LETTER_FOLDS: first and last code point, step, what is added to get its simple case folding.
 * LETTER_PARTS_LOW, LETTER_PARTS_HIGH: a code point and the two that it is composed of.
 * LETTER_RUNS: the first of code points that are one other each, and how many there are;
 * LETTER_ONES: the others, of all runs, in three bytes each.
 * LETTER_MARKS: first code point, how many more follow it, canonical combining class.
 */
HEAD
print "#ifdef LETTERS_LOW\n";
rows(map { sprintf '0x%04x', $_ } grep { $_ < 0x10000 } @letters);
print "#endif\n#ifdef LETTERS_HIGH\n";
rows(map { sprintf '0x%05x', $_ } grep { $_ >= 0x10000 } @letters);
print "#endif\n#ifdef LETTER_FOLDS\n";
rows(map { sprintf '{ 0x%04x, 0x%04x, %d, %d }', @$_{qw(first last)}, $_->{step} || 1, $_->{delta} } @folds);
print "#endif\n#ifdef LETTER_PARTS_LOW\n";
rows(map { sprintf '{ 0x%04x, 0x%04x, 0x%04x }', @$_ } @low);
print "#endif\n#ifdef LETTER_PARTS_HIGH\n";
rows(map { sprintf '{ 0x%05x, 0x%05x, 0x%05x }', @$_ } @high);
print "#endif\n#ifdef LETTER_RUNS\n";
rows(map { sprintf '{ 0x%05x, %d }', @$_ } @runs);
print "#endif\n#ifdef LETTER_ONES\n";
rows(map { sprintf 'ONE(0x%05x)', $_ } @ones);
print "#endif\n#ifdef LETTER_MARKS\n";
rows(map { sprintf '{ 0x%04x, %d, %d }', @$_ } @marks);
print "#endif\n";
