# SPDX-License-Identifier: MIT
#
# Traced.pm - programs that call words with difficult values, and their scripts:
# "bad-values-FAMILY", main.rung and stimulus. A line of the trace shows the inputs, and for
# each word with these types its result (r_) and whether it gave power (ok_). Before each
# call the result is 7, 'before' or TRUE, so an unchanged result can be seen. A person reads
# the traces and blesses them.
package Traced;
use strict;
use warnings;
use Rows;
use Values;

# Lines for one combination of types, by the number of pins.
my @most_lines = (1, 25, 25, 12);

# The types of the pins: one kind of pin at a time gets all of its types.
sub typings {
	my ($row) = @_;
	my @pins = @{$row->{pins}};
	my ($shared) = grep { !$_->{own} } @pins;
	my $usual = sub { my %takes = %{$_[0]{takes}};
		(grep { $takes{$_} } qw(INT REAL TIME), @Values::types)[0] };
	my @made = map { my $type = $_;
		[map { $_->{own} ? $usual->($_) : $type } @pins] } $shared ? @{$shared->{list}} : ();
	for my $own (grep { $_->{own} } @pins) {
		push @made, map { my $type = $_;
			[map { $_->{own} && $_->{takes}{$type} ? $type : $usual->($_) } @pins]
		} @{$own->{list}};
	}
	my %seen;
	return grep { !$seen{"@$_"}++ } @made;
}

# The types of the result.
sub results {
	my ($row, @types) = @_;
	my ($shared) = grep { !$row->{pins}[$_]{own} } 0 .. $#types;
	return $types[$shared] if $row->{result} =~ /^RESULT_(?:SAME|GATE)$/;
	return $1 if $row->{result} =~ /^IEC_(\w+)$/;
	$row->{result} =~ /^RESULT_TO\((.*)\)$/ or die "$row->{word}: result $row->{result}";
	my @results = grep { $_ ne $types[0] } Rows::types_of($1);
	# CONVERT_NS differs from CONVERT only for times.
	return grep { "$_ $types[0]" =~ /TIME|DATE/ } @results if $row->{word} eq 'CONVERT_NS';
	return @results;
}

# A name for an input; values given as bits go to a second variable at the same address.
sub input_name {
	my ($pin, $type) = @_;
	return 'x' . ($pin + 1) . "_$type";
}

sub declare_inputs {
	my ($used) = @_;
	my ($text, $byte) = ('', 8);
	for my $name (sort keys %$used) {
		my $type = $used->{$name};
		my $size = $Values::bytes{$type} // 8;
		my $letter = { 1 => 'B', 2 => 'W', 4 => 'D', 8 => 'L' }->{$size};
		if ($type eq 'STRING') {
			$text .= "  $name : STRING[8];\n";
			next;
		}
		$text .= $type eq 'BOOL' ? "  $name : BOOL;\n" :
			"  $name AT %M$letter$byte : $type;\n";
		$text .= "  ${name}_bits AT %M$letter$byte : " . ($size == 4 ? 'DWORD' : 'LWORD') . ";\n"
			if grep { /^bits:/ } @{$Values::hurt{$type}};
		$byte += 8;
	}
	return $text;
}

sub given {
	my ($name, $value) = @_;
	return $value =~ /^bits:(.*)/ ? "${name}_bits=$1" : "$name=$value";
}

# All calls of a family; words with the same types of inputs together. Words with many types
# of results are separate, to keep lines short.
sub groups {
	my (@rows) = @_;
	my (%group, @order);
	for my $row (@rows) {
		for my $types (typings($row)) {
			my $key = join ' ', $row->{result} =~ /^RESULT_TO/ ? $row->{word} : (), @$types;
			push @order, $key if !$group{$key};
			my $group = $group{$key} //= { key => $key, types => $types, calls => [] };
			push @{$group->{calls}}, map { { row => $row, out => $_ } } results($row, @$types);
		}
	}
	return map { $group{$_} } @order;
}

sub call_name {
	my ($call, $group) = @_;
	my @types = @{$group->{types}};
	my $name = "$call->{row}{word}_" . join '_', grep { $_ } map {
		$_ && $types[$_] eq $types[$_ - 1] ? '' : $types[$_] } 0 .. $#types;
	$name .= "_$call->{out}" if $call->{row}{result} =~ /^RESULT_TO/;
	$name =~ s/TIME_OF_DAY/TOD/g;
	$name =~ s/DATE_AND_TIME/DT/g;
	return $name;
}

# The texts of main.rung and stimulus of a family of functions.
sub functions {
	my ($family, @rows) = @_;
	my (%inputs, $declared, $rungs, $script);
	$declared = $rungs = $script = '';
	for my $group (groups(@rows)) {
		my @types = @{$group->{types}};
		my @names = map { input_name($_, $types[$_]) } 0 .. $#types;
		my $on = 'on_' . $group->{key} =~ s/ /_/gr;
		my @shown = @names;
		$inputs{$names[$_]} = $types[$_] for 0 .. $#names;
		$inputs{$on} = 'BOOL';
		for my $call (@{$group->{calls}}) {
			my $name = call_name($call, $group);
			my $pins = $call->{row}{pins};
			$declared .= "  r_$name : $call->{out}" . ($call->{out} eq 'STRING' ? '[8]' : '') .
				";\n  ok_$name : BOOL;\n";
			$rungs .= "RUNG\n  | NO $on | [ r_$name := $Values::before{$call->{out}} ] " .
				"| $call->{row}{word} " . join(' ', map { "$pins->[$_]{name}:=$names[$_]" }
				0 .. $#names) . " OUT=>r_$name | COIL ok_$name |\n";
			push @shown, "r_$name", "ok_$name";
		}
		my @lists = map { $Values::hurt{$_} } @types;
		$script .= "\@echo $group->{key}\n\@print @shown SYS_ERRORS\n";
		my $first = "$on=1 ";
		for my $values (Values::combinations($most_lines[@lists] // $most_lines[-1], @lists)) {
			$script .= $first . join(' ', map { given($names[$_], $values->[$_]) }
				0 .. $#names) . "\n";
			$first = '';
		}
		$script .= "\@echo EN FALSE\n$on=0\n";
	}
	my $text = program("Functions of the family $family on values that hurt",
		declare_inputs(\%inputs) . $declared, $rungs);
	return ('main.rung' => $text, 'stimulus' => $script);
}

sub program {
	my ($title, $declared, $rungs) = @_;
	return "RUNGBOARD 1\nPROJECT \"$title\"\n\nVAR\n$declared" .
		"END_VAR\n\nPROGRAM Main LD\n${rungs}END_PROGRAM\n";
}

# The same for a family of function blocks: the values of each input in turn, with and
# without power.
sub blocks {
	my ($family, @words) = @_;
	my (%inputs, $declared, $rungs, $script);
	$declared = $rungs = $script = '';
	for my $word (@words) {
		my @in = grep { $_->{direction} eq 'in' } @{$word->{pins}};
		my $power = "go_$word->{word}";
		$inputs{$power} = 'BOOL';
		my @given = grep { $_ != $in[0] || $_->{type} ne 'BOOL' } @in;
		my %name = map { $_->{pin} => "$word->{word}_$_->{pin}" } @given;
		$inputs{$name{$_->{pin}}} = $_->{type} for @given;
		$declared .= "  b_$word->{word} : $word->{word};\n";
		$rungs .= "RUNG\n  | NO $power | $word->{word} b_$word->{word} " .
			join(' ', map { "$_->{pin}:=$name{$_->{pin}}" } @given) . " |\n";
		my @out = map { "b_$word->{word}.$_->{pin}" }
			grep { $_->{direction} eq 'out' } @{$word->{pins}};
		$script .= "\@echo $word->{word}\n\@print $power " .
			join(' ', map { $name{$_->{pin}} } @given) . " @out SYS_ERRORS\n";
		for my $values (Values::combinations($most_lines[@given] // $most_lines[-1],
				map { $Values::hurt{$_->{type}} } @given)) {
			$script .= join(' ', "$power=1", map { given($name{$given[$_]{pin}},
				$values->[$_]) } 0 .. $#given) . "\n$power=0\n";
		}
	}
	my $text = program("Function blocks of the family $family on values that hurt",
		declare_inputs(\%inputs) . $declared, $rungs);
	return ('main.rung' => $text, 'stimulus' => $script);
}

1;
