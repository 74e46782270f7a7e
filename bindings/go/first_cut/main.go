// Cuts a sheet in two: go run ./first_cut
package main

import (
	"example.com/kiri"
	"fmt"
)

func main() {
	world, _ := kiri.NewWorld(nil)
	sheet, _ := world.CreateRectangle(1, 1, 16, 16, nil)
	cut, _ := sheet.BeginCut([2]float32{-0.1, 0.4})
	cut.Extend([][2]float32{{1.1, 0.6}})
	cut.End()
	world.Tick(1.0/60, 1)
	counts, _ := sheet.Counts()
	fmt.Println(counts.Pieces, "pieces")
}
