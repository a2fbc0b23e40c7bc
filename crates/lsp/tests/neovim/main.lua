-- docs/editors/neovim/tracer.lua in Neovim without a screen, with the real server. Run by `cargo xtask prove editors`.

local root = vim.fn.getcwd()
vim.g.tracer_path = vim.fn.fnamemodify(vim.env.TRACER or "target/debug/tracer", ":p")
local folder = vim.fn.tempname()
vim.fn.mkdir(folder)

local SCENE = [[
Scene(
    background:1,
    materials: { "red": Diffuse(albedo: "#ff0000") },
    objects: [Sphere(center: (0, 0, 0), radus: 1, material: "red")],
)
]]

local function write(name, text)
  local file = assert(io.open(folder .. "/" .. name, "w"))
  file:write(text)
  file:close()
end

local function text()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n") .. "\n"
end

local function equal(found, expected)
  assert(vim.deep_equal(found, expected), "found " .. vim.inspect(found) .. ", expected " .. vim.inspect(expected))
end

local function until_holds(what, holds)
  assert(vim.wait(60000, holds, 10), "in vain: " .. what .. "; marks: " .. vim.inspect(vim.diagnostic.get(0)))
end

local function marks(count)
  until_holds(count .. " marks", function() return #vim.diagnostic.get(0) == count end)
  return vim.diagnostic.get(0)
end

-- Puts the cursor at a letter of a word.
local function go(word, letter)
  for row, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local column = line:find(word, 1, true)
    if column then
      vim.api.nvim_win_set_cursor(0, { row, column - 1 + (letter or 0) })
      return
    end
  end
  error("no " .. word)
end

local function servers()
  return vim.lsp.get_clients and vim.lsp.get_clients({ bufnr = 0 }) or vim.lsp.buf_get_clients(0)
end

-- What the server answers about the cursor's place.
local function ask(method, more)
  local params = vim.tbl_extend("force", vim.lsp.util.make_position_params(0, "utf-16"), more or {})
  local answers = vim.lsp.buf_request_sync(0, method, params, 60000)
  assert(answers, method)
  local _, answer = next(answers)
  assert(not answer.error and not answer.err, vim.inspect(answer))
  return answer.result
end

local function test()
  vim.cmd("filetype on")
  dofile(root .. "/docs/editors/neovim/tracer.lua")
  write("a.ron", SCENE)
  vim.cmd("edit " .. folder .. "/a.ron")
  equal(vim.bo.filetype, "ron")
  local mark = marks(1)[1]
  equal({ mark.lnum, mark.col, mark.severity }, { 3, 40, vim.diagnostic.severity.ERROR })
  assert(mark.message:find("radus", 1, true), mark.message)

  -- A quick fix.
  local range = { start = { line = 3, character = 40 }, ["end"] = { line = 3, character = 45 } }
  local action = ask("textDocument/codeAction", { range = range, context = { diagnostics = {} } })[1]
  equal(action.isPreferred, true)
  vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
  equal(text(), (SCENE:gsub("radus", "radius")))
  marks(0)

  -- Layout, as the editor's own command does it.
  if vim.lsp.buf.formatting_sync then
    vim.lsp.buf.formatting_sync({}, 60000)
  else
    vim.lsp.buf.format({ timeout_ms = 60000 })
  end
  assert(text():find("\n    background: 1,\n", 1, true), text())

  go("radius", 2)
  assert(ask("textDocument/hover").contents.value:find("**radius**", 1, true))
  go("radius")
  local labels = vim.tbl_map(function(item) return item.label end, ask("textDocument/completion"))
  assert(vim.tbl_contains(labels, "radius") or vim.tbl_contains(labels, "rotation"), vim.inspect(labels))

  -- Where the name is defined: the editor goes there by itself.
  go('material: "red"', 11)
  vim.lsp.buf.definition()
  local row = vim.fn.search('"red": Diffuse', "nw")
  until_holds("the definition", function() return vim.api.nvim_win_get_cursor(0)[1] == row end)
  equal(vim.api.nvim_win_get_cursor(0)[2], vim.fn.getline(row):find("red", 1, true) - 1)

  -- Another name.
  vim.lsp.buf.rename("crimson")
  until_holds("a new name", function()
    return select(2, text():gsub('"crimson"', "")) == 2 and not text():find('"red"', 1, true)
  end)
  marks(0)

  -- A scene in TOML is marked, other files are not: the scene after them tells that they have been looked at.
  write("Cargo.toml", "[package]\nname = \"a\"\nversion = \"0.1.0\"\n")
  write("package.json", '{ "name": "a", "version": "0.1.0", "scripts": {} }\n')
  write("b.toml", "[[objects]]\nSphere = { center = [0, 0, 0], radus = 1 }\n")
  local others = {}
  for _, name in ipairs({ "Cargo.toml", "package.json" }) do
    vim.cmd("edit " .. folder .. "/" .. name)
    table.insert(others, vim.api.nvim_get_current_buf())
    equal(vim.tbl_count(servers()), 1)
    equal(ask("textDocument/hover"), nil)
  end
  vim.cmd("edit " .. folder .. "/b.toml")
  marks(1)
  for _, buffer in ipairs(others) do
    equal(vim.diagnostic.get(buffer), {})
  end
end

local good, why = xpcall(test, debug.traceback)
vim.fn.delete(folder, "rf")
print((good and "Neovim: all is well" or why) .. "\n")
vim.cmd(good and "qall!" or "cquit 1")
